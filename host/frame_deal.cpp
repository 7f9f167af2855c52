#include "host/frame_deal.h"

#include "host/stopwatch.h"

#include <algorithm>
#include <exception>
#include <numeric>
#include <thread>
#include <utility>

namespace clucida::host {

FrameDeal::FrameDeal(const std::vector<std::size_t>& frames, const std::vector<double>& seconds, std::size_t window)
    : last_(seconds), window_(window), open_(frames.begin(), frames.end())
{
    for (const double s : seconds) speeds_.push_back(1 / s);
}

double FrameDeal::share(std::size_t taker) const
{
    return speeds_[taker] / std::accumulate(speeds_.begin(), speeds_.end(), 0.0);
}

std::optional<std::size_t> FrameDeal::take(std::size_t taker)
{
    std::unique_lock lock(mutex_);
    for (;;) {
        const double frames = share(taker) * static_cast<double>(std::min(open_.size(), window_));
        if (stopped_ || frames < 1) return std::nullopt;
        const std::size_t next = *open_.begin();
        if (taken_.empty() || next < *taken_.begin() + window_) {
            open_.erase(next);
            taken_.insert(next);
            return next;
        }
        changed_.wait(lock);
    }
}

void FrameDeal::finish(std::size_t taker, std::size_t frame, double seconds)
{
    const std::lock_guard lock(mutex_);
    taken_.erase(frame);
    speeds_[taker] = 1 / std::max(std::min(seconds, last_[taker]), 1e-9);
    last_[taker] = seconds;
    changed_.notify_all();
}

void FrameDeal::give_back(std::size_t taker, std::size_t frame)
{
    const std::lock_guard lock(mutex_);
    taken_.erase(frame);
    open_.insert(frame);
    speeds_[taker] = 0;
    changed_.notify_all();
}

void FrameDeal::stop()
{
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

std::vector<std::size_t> FrameDeal::left()
{
    const std::lock_guard lock(mutex_);
    return {open_.begin(), open_.end()};
}

std::vector<std::size_t> deal_frames(const std::vector<std::size_t>& frames, const std::vector<double>& seconds,
                                     std::size_t window, const RenderDealt& render, const TellFailure& failed)
{
    FrameDeal deal(frames, seconds, window);
    std::mutex mutex; // of what follows
    std::exception_ptr end;
    const auto work = [&](std::size_t taker) {
        while (const auto frame = deal.take(taker)) {
            try {
                const Stopwatch watch;
                render(taker, *frame);
                deal.finish(taker, *frame, watch.seconds());
            } catch (const TakerFailure& e) {
                deal.give_back(taker, *frame);
                const std::lock_guard lock(mutex);
                return failed(taker, e.what());
            } catch (...) {
                deal.stop();
                const std::lock_guard lock(mutex);
                if (!end) end = std::current_exception();
                return;
            }
        }
    };
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < seconds.size(); ++i) threads.emplace_back(work, i);
    threads.clear();
    if (end) std::rethrow_exception(end);
    return deal.left();
}

} // namespace clucida::host
