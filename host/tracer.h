/// What traces regions of one frame: a device that holds the scene and its kernels.
#pragma once

#include "host/regions.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace clucida::host {

/// A region in the making, with memory of its own.
class Lane {
public:
    virtual ~Lane() = default;
    /// Starts samples begin to end - 1 of the region's pixels, whose sums are added to what the lane has, or begin anew
    /// from sample 0. After the last of them, sums are wanted. @throws cl::Error, Failure
    virtual void launch(const Region& region, unsigned begin, unsigned end, bool last) = 0;
    /// Waits until that is done. @throws cl::Error, Failure
    virtual void wait() = 0;

    std::vector<float> sums; ///< r, g, b and one more of each pixel; pixels beyond the picture are of no account
    std::vector<std::uint32_t> counters; ///< of the last launch: rows of STAT_COUNT
    double kernel_seconds = 0;           ///< of the last launch, as the device says; 0 if it does not
};

class Tracer {
public:
    virtual ~Tracer() = default;
    /// Of whose multiples regions are, pixels.
    virtual Shape grain() const = 0;
    /// Of a work-group, work-items.
    virtual Shape group() const { return {1, 1}; }
    /// Lanes that may be launched at a time.
    virtual unsigned most_in_flight() const = 0;
    /// Samples of a pixel that a launch may take.
    virtual unsigned most_samples() const { return samples_per_launch; }
    /// Pixels that a lane can have.
    virtual std::size_t most_pixels() const = 0;
    /// @throws cl::Error
    virtual std::unique_ptr<Lane> make_lane(std::size_t pixels) = 0;
};

} // namespace clucida::host
