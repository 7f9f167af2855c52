// How frames of a range are dealt out to devices of which some are slow or fail. No device is needed.
#include "host/frame_deal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <latch>
#include <numeric>
#include <thread>
#include <utility>

namespace clucida::host {
namespace {

std::vector<std::size_t> range(std::size_t count)
{
    std::vector<std::size_t> out(count);
    std::iota(out.begin(), out.end(), std::size_t{0});
    return out;
}

TEST(FrameDeal, one_taker_has_them_all_in_order)
{
    FrameDeal deal({2, 5, 9}, {0.5}, 4);
    for (const std::size_t frame : {2U, 5U, 9U}) {
        EXPECT_EQ(deal.take(0), frame);
        deal.finish(0, frame, 0.5);
    }
    EXPECT_EQ(deal.take(0), std::nullopt);
    EXPECT_TRUE(deal.left().empty());
}

TEST(FrameDeal, the_last_ones_are_left_for_all)
{
    FrameDeal deal(range(4), {1, 3}, 16); // shares of 3/4 and 1/4
    EXPECT_EQ(deal.take(1), 0U);
    EXPECT_EQ(deal.take(1), std::nullopt) << "the other does three meanwhile";
    EXPECT_EQ(deal.take(0), 1U);
    EXPECT_EQ(deal.take(0), 2U);
    EXPECT_EQ(deal.take(0), std::nullopt) << "together they are done with it before one alone";
    EXPECT_EQ(deal.left(), std::vector<std::size_t>{3});
}

TEST(FrameDeal, goes_by_how_long_a_taker_really_takes)
{
    FrameDeal deal(range(6), {1, 1}, 16);
    EXPECT_EQ(deal.take(1), 0U);
    deal.finish(1, 0, 9);
    EXPECT_EQ(deal.take(1), 1U) << "one stall is no habit";
    deal.finish(1, 1, 9); // a share of 1/10
    EXPECT_EQ(deal.take(1), std::nullopt);
    EXPECT_EQ(deal.take(0), 2U);
}

TEST(FrameDeal, nobody_is_too_far_ahead)
{
    FrameDeal deal(range(20), {1, 1}, 3);
    EXPECT_EQ(deal.take(0), 0U);
    EXPECT_EQ(deal.take(1), 1U);
    deal.finish(1, 1, 1);
    EXPECT_EQ(deal.take(1), 2U);
    deal.finish(1, 2, 1);
    std::optional<std::size_t> taken;
    std::jthread waiting([&] { taken = deal.take(1); });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_FALSE(taken) << "0 is not finished";
    deal.finish(0, 0, 1);
    waiting.join();
    EXPECT_EQ(taken, 3U);
    FrameDeal uneven(range(20), {1, 4}, 3);
    EXPECT_EQ(uneven.take(1), std::nullopt) << "the other would wait for it";
}

TEST(FrameDeal, a_stop_ends_it)
{
    FrameDeal deal(range(20), {1, 1}, 2);
    EXPECT_EQ(deal.take(0), 0U);
    EXPECT_EQ(deal.take(1), 1U);
    deal.finish(1, 1, 1);
    std::jthread waiting([&] { EXPECT_EQ(deal.take(1), std::nullopt); });
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    deal.stop();
}

/// How often each frame was rendered, and by whom.
struct Rendered {
    explicit Rendered(std::size_t frames) : times(frames), by(frames) {}
    std::mutex mutex;
    std::vector<int> times;
    std::vector<std::size_t> by;
    std::vector<std::string> failures;

    void add(std::size_t taker, std::size_t frame)
    {
        const std::lock_guard lock(mutex);
        ++times[frame];
        by[frame] = taker;
    }
    TellFailure tell()
    {
        return [this](std::size_t taker, const std::string& why) {
            failures.push_back(std::to_string(taker) + ": " + why);
        };
    }
};

TEST(DealFrames, each_is_rendered_once_or_left)
{
    Rendered done(60);
    std::latch all_have_one(3); // else a thread that starts late on a busy machine finds none
    std::array<bool, 3> has_one{};
    const auto left = deal_frames(
        range(60), {1e-3, 2e-3, 4e-3}, 12,
        [&](std::size_t taker, std::size_t frame) {
            if (!std::exchange(has_one.at(taker), true)) all_have_one.arrive_and_wait();
            std::this_thread::sleep_for(std::chrono::milliseconds(1 << taker));
            done.add(taker, frame);
        },
        done.tell());
    for (const std::size_t frame : left) ++done.times[frame];
    EXPECT_TRUE(std::ranges::all_of(done.times, [](int n) { return n == 1; }));
    EXPECT_LT(left.size(), 6U);
    for (const std::size_t taker : {0U, 1U, 2U}) EXPECT_GT(std::ranges::count(done.by, taker), 0);
    EXPECT_TRUE(done.failures.empty());
}

TEST(DealFrames, what_a_taker_had_that_fails_is_for_the_others)
{
    Rendered done(40);
    std::atomic<bool> had = false;
    const auto left = deal_frames(
        range(40), {1e-3, 1e-3}, 8,
        [&](std::size_t taker, std::size_t frame) {
            if (taker == 1) {
                had = true;
                throw TakerFailure("out of order");
            }
            while (!had) std::this_thread::yield();
            done.add(taker, frame);
        },
        done.tell());
    EXPECT_TRUE(left.empty());
    EXPECT_TRUE(std::ranges::all_of(done.times, [](int n) { return n == 1; }));
    EXPECT_EQ(done.failures, std::vector<std::string>{"1: out of order"});
}

TEST(DealFrames, if_all_fail_what_they_had_is_left)
{
    Rendered done(6);
    const auto fail = [](std::size_t, std::size_t) { throw TakerFailure("gone"); };
    EXPECT_EQ(deal_frames(range(6), {1, 1}, 8, fail, done.tell()), range(6));
    EXPECT_EQ(done.failures.size(), 2U);
}

TEST(DealFrames, what_is_no_taker_s_fault_ends_it)
{
    Rendered done(1000);
    const auto full = [&](std::size_t taker, std::size_t frame) {
        if (frame == 3) throw std::runtime_error("the disk is full");
        done.add(taker, frame);
    };
    EXPECT_THROW(deal_frames(range(1000), {1, 1}, 8, full, done.tell()), std::runtime_error);
    EXPECT_LT(std::ranges::count(done.times, 1), 1000);
    EXPECT_TRUE(done.failures.empty());
}

} // namespace
} // namespace clucida::host
