/// What a picture loses by what is spared or rounded, told by the oracle from every few pixels.
#pragma once

#include "bench/oracle/oracle.h"
#include "host/picture.h"

namespace clucida::bench {

/// How far apart pictures are with and without what is spared.
struct Cost {
    double rmse = 0, max_error = 0, psnr = 0;
    double equal = 1; ///< equal_share
};

/// The share of pixels whose 8-bit values are all the same; 1 if there are none.
double equal_share(const host::Picture& a, const host::Picture& b);

Cost cost_of(const host::Picture& a, const host::Picture& b);

struct OracleCosts {
    /// The scene and all rays disturbed by u = 2^-24 (oracle/disturb.h), against undisturbed: what a single rounding of
    /// each number comes to in the pixels whose path stays. A tracer in float can hardly do better.
    Cost rounding;
    Cost colors; ///< filters in 32 bits, against exact ones
};

OracleCosts oracle_costs(const scene::Scene& scene, const scene::View& view, std::span<const oracle::Pixel> pixels,
                         unsigned threads);

} // namespace clucida::bench
