// How frames are divided among devices: regions, and teams of which some are slow or fail. No device is needed.
#include "host/errors.h"
#include "host/launch_shape.h"
#include "host/trace.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <thread>

namespace clucida::host {
namespace {

using std::chrono::milliseconds;

/// How often each pixel lies in a region that was taken.
class Counts {
public:
    explicit Counts(Shape picture) : picture_(picture), counts_(area(picture)) {}
    void add(const Region& region)
    {
        const Shape part = region.visible(picture_);
        for (unsigned j = 0; j < part.height; ++j)
            for (unsigned i = 0; i < part.width; ++i)
                ++counts_[std::size_t{region.y + j} * picture_.width + region.x + i];
    }
    bool all(int n) const
    {
        return std::ranges::all_of(counts_, [n](int c) { return c == n; });
    }

private:
    Shape picture_;
    std::vector<int> counts_;
};

TEST(Regions, cover_every_pixel_once_whatever_the_cells)
{
    for (const Shape picture : {Shape{37, 23}, {1, 1}, {640, 360}, {1000, 3}})
        for (const Shape cell : {Shape{16, 8}, {32, 32}, {1, 1}, {700, 400}})
            for (const std::size_t most : {1U, 200U, 4096U, 1U << 30}) {
                Regions regions(picture, cell, {{1e-6, most}}, 64);
                Counts counts(picture);
                while (const auto region = regions.take(0)) {
                    EXPECT_EQ(region->shape.width % cell.width, 0U);
                    EXPECT_EQ(region->shape.height % cell.height, 0U);
                    EXPECT_LE(area(region->shape), std::max(most, area(cell)));
                    EXPECT_LE(region->shape.height, std::max(64U, cell.height));
                    counts.add(*region);
                    EXPECT_TRUE(regions.finish(*region));
                }
                EXPECT_TRUE(regions.is_complete());
                EXPECT_TRUE(counts.all(1)) << picture.width << ' ' << cell.width << ' ' << most;
            }
}

TEST(Regions, one_taker_has_regions_as_large_as_it_may)
{
    Regions regions({256, 256}, {32, 32}, {{1e-6, std::size_t{256} * 64}}, 65536);
    for (unsigned y = 0; y < 256; y += 64) EXPECT_EQ(regions.take(0), (Region{0, y, {256, 64}}));
}

TEST(Regions, several_take_less_the_less_is_left_and_the_slow_one_less_than_the_fast_one)
{
    Regions regions({1024, 1024}, {32, 32}, {{1e-6, 1U << 30}, {9e-6, 1U << 30}}, 65536);
    const std::size_t fast = area(regions.take(0)->shape), slow = area(regions.take(1)->shape);
    EXPECT_NEAR(static_cast<double>(fast), 0.45 * 1024 * 1024, 33.0 * 1024);
    EXPECT_LT(slow, fast / 4);
    EXPECT_LT(area(regions.take(0)->shape), fast);
}

TEST(Regions, what_a_failed_taker_had_is_given_to_another)
{
    Regions regions({64, 64}, {32, 32}, {{1e-6, 2048}, {1e-6, 2048}}, 65536);
    const Region lost = *regions.take(0), lost_too = *regions.take(0);
    regions.give_back(0);
    Counts counts({64, 64});
    while (const auto region = regions.wait_and_take(1)) {
        counts.add(*region);
        EXPECT_TRUE(regions.finish(*region));
    }
    EXPECT_TRUE(counts.all(1));
    EXPECT_FALSE(regions.finish(lost)) << "it came too late";
    EXPECT_FALSE(regions.finish(lost_too));
}

TEST(Regions, the_last_ones_are_done_again_by_who_would_be_done_sooner)
{
    Regions regions({64, 32}, {32, 32}, {{1, 1U << 30}, {1e-3, 1U << 30}}, 65536); // s a pixel
    const Region slow = *regions.take(0), fast = *regions.take(1);
    EXPECT_TRUE(regions.finish(fast));
    EXPECT_EQ(regions.take(1), slow);
    EXPECT_EQ(regions.take(1), std::nullopt) << "once is enough";
    EXPECT_TRUE(regions.finish(slow));
    EXPECT_FALSE(regions.finish(slow)) << "the other was sooner";
    EXPECT_TRUE(regions.is_complete());
}

TEST(Regions, a_taker_that_is_stuck_is_not_waited_for)
{
    Regions regions({32, 32}, {32, 32}, {{1e-9, 1024}, {1e-6, 1024}}, 65536);
    const Region stuck = *regions.take(0);
    EXPECT_EQ(regions.take(1), std::nullopt) << "the fast one is nearly done";
    EXPECT_EQ(regions.wait_and_take(1), stuck);
}

TEST(Regions, a_stop_ends_the_wait)
{
    Regions regions({32, 32}, {32, 32}, {{1e3, 1024}, {1e3, 1024}}, 65536);
    ASSERT_TRUE(regions.take(0));
    std::jthread stopper([&] {
        std::this_thread::sleep_for(milliseconds(10));
        regions.stop();
    });
    EXPECT_EQ(regions.wait_and_take(1), std::nullopt);
    EXPECT_FALSE(regions.is_complete());
}

/// Writes each pixel's number and the samples' into the sums; may be slow, or fail after some launches.
class FakeTracer : public Tracer {
public:
    struct Ways {
        Shape picture;
        milliseconds pause{0};
        int failing_launch = -1;
        std::future<void>* release = nullptr; ///< not done before this is
    };
    explicit FakeTracer(Ways ways) : ways_(ways) {}
    /// Nothing is done before the other has launched so often.
    void wait_for(const FakeTracer& other, int launches = 1)
    {
        other_ = &other;
        others_launches_ = launches;
    }
    Shape grain() const override { return {8, 4}; }
    unsigned most_in_flight() const override { return 2; }
    std::size_t most_pixels() const override { return 1U << 24; }
    std::unique_ptr<Lane> make_lane(std::size_t pixels) override { return std::make_unique<FakeLane>(*this, pixels); }

    std::atomic<int> launches{0};

private:
    struct FakeLane : Lane {
        FakeLane(FakeTracer& of, std::size_t pixels) : tracer(of)
        {
            sums.resize(4 * pixels);
            counters.resize(STAT_COUNT);
        }
        void launch(const Region& region, unsigned begin, unsigned end, bool) override
        {
            ASSERT_LE(4 * area(region.shape), sums.size());
            if (tracer.launches++ == tracer.ways_.failing_launch) throw Failure("it is broken");
            counters[STAT_PRIMARY] = 0;
            const Shape part = region.visible(tracer.ways_.picture);
            for (unsigned j = 0; j < part.height; ++j)
                for (unsigned i = 0; i < part.width; ++i) {
                    float* sum = &sums[std::size_t{4} * (std::size_t{j} * region.shape.width + i)];
                    if (begin == 0) sum[0] = sum[1] = sum[2] = 0;
                    for (unsigned k = begin; k < end; ++k) {
                        sum[0] += static_cast<float>(region.x + i);
                        sum[1] += static_cast<float>(region.y + j);
                        sum[2] += static_cast<float>(k);
                        ++counters[STAT_PRIMARY];
                    }
                }
        }
        void wait() override
        {
            std::this_thread::sleep_for(tracer.ways_.pause);
            while (tracer.other_ && tracer.other_->launches < tracer.others_launches_)
                std::this_thread::sleep_for(milliseconds(1));
            if (tracer.ways_.release) tracer.ways_.release->wait();
        }
        FakeTracer& tracer;
    };
    Ways ways_;
    const FakeTracer* other_ = nullptr;
    int others_launches_ = 0;
};

struct Traced {
    Frame frame;
    std::vector<Worker> workers;
};

Traced trace(std::vector<FakeTracer*> tracers, Shape picture, std::vector<double> speeds, RenderHooks hooks = {})
{
    Traced out;
    for (std::size_t i = 0; i < tracers.size(); ++i) out.workers.push_back({tracers[i], speeds[i]});
    RenderSettings settings;
    settings.picture = picture;
    settings.samples = 20;
    out.frame.picture = make_picture(picture.width, picture.height);
    trace_frame(out.workers, settings, hooks, out.frame);
    return out;
}

/// Of 20 samples, whose numbers' mean is 9.5.
void expect_complete(const Frame& frame, Shape picture)
{
    for (unsigned y = 0; y < picture.height; ++y)
        for (unsigned x = 0; x < picture.width; ++x) {
            const float* rgb = &frame.picture.rgb[3 * (std::size_t{y} * picture.width + x)];
            ASSERT_EQ(rgb[0], static_cast<float>(x));
            ASSERT_EQ(rgb[1], static_cast<float>(y));
            ASSERT_EQ(rgb[2], 9.5f);
        }
    EXPECT_EQ(frame.statistics.primary, 20 * area(picture)) << "each pixel counts once, whoever traced it";
}

constexpr Shape picture{333, 217};

TEST(Teams, share_a_frame_by_their_speed)
{
    FakeTracer fast({picture}), slow({picture});
    fast.wait_for(slow);
    slow.wait_for(fast);
    const Traced traced = trace({&fast, &slow}, picture, {1e-6, 4e-6});
    expect_complete(traced.frame, picture);
    EXPECT_GT(fast.launches, 0);
    EXPECT_GT(slow.launches, 0);
}

TEST(Teams, a_device_that_fails_midway_gives_its_regions_to_the_others)
{
    for (const int launch : {0, 1, 3}) {
        FakeTracer sound({picture}), broken({.picture = picture, .failing_launch = launch});
        sound.wait_for(broken, launch + 1);
        const Traced traced = trace({&sound, &broken}, picture, {1e-6, 1e-6});
        expect_complete(traced.frame, picture);
        EXPECT_EQ(traced.workers[0].failure, "");
        EXPECT_EQ(traced.workers[1].failure, "it is broken");
    }
}

TEST(Teams, if_all_fail_the_frame_does)
{
    FakeTracer one({.picture = picture, .failing_launch = 2}), two({.picture = picture, .failing_launch = 1});
    EXPECT_THROW(trace({&one, &two}, picture, {1e-6, 1e-6}), Failure);
}

TEST(Teams, one_that_hangs_does_not_hold_up_the_frame)
{
    std::promise<void> complete;
    std::future<void> release = complete.get_future();
    FakeTracer quick({picture}), stuck({.picture = picture, .release = &release});
    quick.wait_for(stuck);
    unsigned rows = 0;
    trace({&quick, &stuck}, picture, {1e-7, 1e-7}, {.rows = [&](unsigned y, std::span<const float> rgb) {
              EXPECT_EQ(y, rows);
              rows += static_cast<unsigned>(rgb.size() / (3 * picture.width));
              if (rows == picture.height) complete.set_value(); // else the test never ends
          }});
    EXPECT_EQ(rows, picture.height);
    EXPECT_GT(stuck.launches, 0);
}

TEST(Teams, what_a_hook_throws_ends_the_frame_and_is_no_device_s_fault)
{
    FakeTracer one({picture, milliseconds(1)}), two({picture, milliseconds(1)});
    EXPECT_THROW(trace({&one, &two}, picture, {1e-6, 1e-6},
                       {.rows = [](unsigned, std::span<const float>) { throw Failure("the disk is full"); }}),
                 Failure);
    std::atomic<int> asked{0};
    EXPECT_THROW(trace({&one, &two}, picture, {1e-6, 1e-6}, {.cancelled = [&] { return ++asked > 3; }}), Interrupted);
}

TEST(LaunchShape, the_usual_group_stays_unless_another_is_clearly_faster)
{
    const std::vector<Shape> some{{8, 4}, {16, 4}, {32, 1}};
    const auto timed = [&](double of_8x4, double of_32x1) {
        return fastest_group({16, 4}, some, [=](Shape s) -> std::optional<double> {
            return s == Shape{8, 4} ? of_8x4 : s == Shape{32, 1} ? of_32x1 : 1.0;
        });
    };
    EXPECT_EQ(timed(0.99, 2), (Shape{16, 4}));
    EXPECT_EQ(timed(0.5, 2), (Shape{8, 4}));
    EXPECT_EQ(timed(0.5, 0.4), (Shape{32, 1}));
    EXPECT_EQ(timed(2, 0.4), (Shape{32, 1}));
    const auto none = [](Shape s) { return s == Shape{32, 1} ? std::optional(1.0) : std::nullopt; };
    EXPECT_EQ(fastest_group({16, 4}, some, none), (Shape{32, 1})) << "what the kernel cannot take is passed over";
}

TEST(LaunchShape, looks_that_take_long_are_few)
{
    int looks = 0;
    fastest_group({16, 4}, candidate_groups(1024), [&](Shape) -> std::optional<double> {
        ++looks;
        std::this_thread::sleep_for(milliseconds(600));
        return 1.0;
    });
    EXPECT_EQ(looks, 2);
}

TEST(LaunchShape, candidates_fit_the_device)
{
    for (const std::size_t most : {1U, 32U, 64U, 4096U})
        for (const Shape s : candidate_groups(most)) EXPECT_LE(area(s), most);
    EXPECT_GT(candidate_groups(256).size(), 5U);
}

TEST(LaunchShape, what_was_kept_is_found_by_the_same_device_alone)
{
    const auto folder = std::filesystem::temp_directory_path() / ("clucida_shape_" + std::to_string(::getpid()));
    ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    DeviceInfo device, other;
    device.name = "one";
    other.name = "other";
    EXPECT_EQ(kept_group(device), std::nullopt);
    EXPECT_TRUE(keep_group(device, {32, 4}));
    EXPECT_EQ(kept_group(device), (Shape{32, 4}));
    EXPECT_EQ(kept_group(other), std::nullopt);
    EXPECT_TRUE(keep_group(device, {0, 4}));
    EXPECT_EQ(kept_group(device), std::nullopt) << "nonsense is none";
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace clucida::host
