/// What a picture loses by what is spared or rounded, told by the oracle from every few pixels.
#pragma once

#include "bench/oracle/oracle.h"
#include "host/picture.h"

namespace clucida::bench {

/// How far apart pictures are with and without what is spared.
struct Cost {
    double rmse = 0, max_error = 0, psnr = 0;
    double equal = 1; ///< the share of pixels whose 8-bit values are all the same
};

Cost cost_of(const host::Picture& a, const host::Picture& b);

/// Filters in 32 bits, against exact ones.
Cost cost_of_colors(const scene::Scene& scene, const oracle::Options& options, std::span<const oracle::Pixel> pixels,
                    unsigned threads);

/// The scene and all rays disturbed by u = 2^-24 (oracle/disturb.h), against undisturbed: what a single rounding of
/// each number comes to in the pixels whose path stays. A tracer in float can hardly do better.
Cost cost_of_rounding(const scene::Scene& scene, const oracle::Options& options, std::span<const oracle::Pixel> pixels,
                      unsigned threads);

} // namespace clucida::bench
