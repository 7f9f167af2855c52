/// Frames of a range, dealt out to several devices: each renders whole ones, at its own speed.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace clucida::host {

/// Who takes frames cannot go on; the others can.
struct TakerFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Hands out frames in order. Takers may be threads. One gets no more when so few are left that all together, each with
/// a share of every frame, are done with them before it is done with one: what is left then is for all.
class FrameDeal {
public:
    /// seconds: that a frame is expected to take each taker, above 0. window: frames from the first that is not
    /// finished to the last that is handed out; who is too slow for it gets none.
    FrameDeal(const std::vector<std::size_t>& frames, const std::vector<double>& seconds, std::size_t window);

    /// Waits while the next lies beyond the window. nullopt: it gets no more.
    std::optional<std::size_t> take(std::size_t taker);
    /// Done in so many seconds. The next is expected to take that or what the one before took, whichever is less:
    /// one stall of a busy machine does not shut a taker out.
    void finish(std::size_t taker, std::size_t frame, double seconds);
    /// The taker has failed: its frame is for the others, and it is not counted on any more.
    void give_back(std::size_t taker, std::size_t frame);
    /// Nothing more is handed out.
    void stop();
    /// Frames that nobody has.
    std::vector<std::size_t> left();

private:
    double share(std::size_t taker) const;

    std::vector<double> speeds_; ///< of each taker, frames/s
    std::vector<double> last_;   ///< seconds of each taker's last frame
    std::size_t window_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::set<std::size_t> open_, taken_; ///< that nobody has; that somebody has
    bool stopped_ = false;
};

/// A frame by a taker. @throws TakerFailure; anything else ends the work of all
using RenderDealt = std::function<void(std::size_t taker, std::size_t frame)>;
/// A taker has failed. Of one thread at a time.
using TellFailure = std::function<void(std::size_t taker, const std::string& why)>;

/// Renders frames in a thread for each taker, with arguments as FrameDeal's; returns those that are left for all
/// together. @throws what render has thrown, after all have ended
std::vector<std::size_t> deal_frames(const std::vector<std::size_t>& frames, const std::vector<double>& seconds,
                                     std::size_t window, const RenderDealt& render, const TellFailure& failed);

} // namespace clucida::host
