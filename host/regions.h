/// The regions of a frame, which devices take when they have nothing else to do.
#pragma once

#include "host/tiling.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

namespace clucida::host {

/// A rectangle of pixels, of which some may lie beyond the picture's right and lower edges.
struct Region {
    unsigned x = 0, y = 0;
    Shape shape;
    /// What of it lies in the picture.
    Shape visible(Shape picture) const;
    bool operator==(const Region&) const = default;
};

/// Who takes regions: how long a pixel takes it, and how many pixels it takes at most.
struct Taker {
    double pixel_seconds = 0;
    std::size_t most_pixels = 0;
};

/// A grid of cells over the picture, handed out from the top in runs of cells of one row, or of whole rows. Takers may
/// be threads. Of several, each takes less the less is left, so that they end at about the same time; one with nothing
/// left to take does a region of another once more, where it would be done sooner.
class Regions {
public:
    /// most_rows: pixels that a region may be high.
    Regions(Shape picture, Shape cell, std::vector<Taker> takers, unsigned most_rows);

    /// The next region, or nullopt if there is none at the moment.
    std::optional<Region> take(std::size_t taker);
    /// Waits for one. nullopt when the frame is complete, or stopped.
    std::optional<Region> wait_and_take(std::size_t taker);
    /// The taker has done it. False if another was sooner.
    bool finish(const Region& region);
    /// The taker fails: what it had is for the others.
    void give_back(std::size_t taker);
    /// Nothing more is handed out.
    void stop();
    bool is_complete();

private:
    using Clock = std::chrono::steady_clock;
    struct Taken {
        Region region;
        std::vector<std::size_t> takers; ///< the first of them since
        Clock::time_point since;
        bool is_taken_by(std::size_t taker) const;
    };

    bool is_complete_locked() const;
    std::optional<Region> take_locked(std::size_t taker);
    std::optional<Region> carve(std::size_t taker);
    std::optional<Region> second(std::size_t taker);
    std::size_t cells_of(std::size_t taker) const;
    double seconds_of(const Region& region, std::size_t taker) const;

    Shape picture_, cell_;
    std::size_t columns_, rows_;
    std::vector<Taker> takers_;
    std::size_t most_cell_rows_;
    double speed_ = 0; ///< of all, pixels/s

    std::mutex mutex_;
    std::condition_variable changed_;
    std::size_t next_ = 0; ///< cell that nobody has had
    std::vector<Region> returned_;
    std::vector<Taken> taken_; ///< and not done
    bool stopped_ = false;
};

} // namespace clucida::host
