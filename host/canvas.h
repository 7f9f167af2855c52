/// Where regions go when they are traced: the whole picture, or bands of rows that leave in order.
#pragma once

#include "host/picture.h"
#include "host/regions.h"

#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

namespace clucida::host {

/// Takes bands of whole rows from row y, in order from the top.
using TakeRows = std::function<void(unsigned y, std::span<const float> rgb)>;

/// Threads may share it; regions come in any order.
class Canvas {
public:
    /// Of regions that begin and end at multiples of band_height rows. rows may be empty: then all goes to picture.rgb,
    /// which is as large as it has to be.
    Canvas(Picture& picture, unsigned band_height, unsigned samples, const TakeRows& rows);

    /// sums: r, g, b and one float more of each pixel of the region, row by row, of all samples.
    void add(const Region& region, std::span<const float> sums);
    /// Gives the bands away that are complete and whose predecessors are gone. Apart from add, so that a device has
    /// work meanwhile. @throws what rows throws
    void hand_over();

private:
    struct Band {
        std::vector<float> rgb;
        std::size_t missing = 0; ///< pixels
    };
    Band make_band(unsigned y) const;
    float* row(unsigned y);

    Picture& picture_;
    unsigned band_height_;
    float samples_;
    const TakeRows& rows_;

    std::mutex handing_over_; ///< before mutex_
    std::mutex mutex_;
    unsigned first_ = 0; ///< row of the first band
    std::deque<Band> bands_;
};

} // namespace clucida::host
