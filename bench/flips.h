/// Path flips: pixels whose path is not the oracle's, and whether rounding explains them.
#pragma once

#include "bench/divergence.h"
#include "bench/faces.h"

#include <cstddef>

namespace clucida::bench {

struct PathFlip {
    oracle::Pixel pixel;
    std::vector<Divergence> divergences; ///< of the kernels' path from the oracle's, not empty
};

/// A flip is explained if for each of its divergences the oracle goes the kernels' way when the scene and the ray are
/// disturbed by at most flip_disturbance, relative to each number.
constexpr double flip_disturbance = 4 * 0x1p-24;

struct Explained {
    std::size_t looked_at = 0, explained = 0; ///< flips
    unsigned seeds = 0;                       ///< disturbances that were tried until none was left, or the most
    std::vector<oracle::Pixel> unexplained;
};

/// Tries disturbances 1, 2, ... `most_seeds`, of so many flips at most, chosen evenly.
Explained explain(const scene::Scene& scene, const oracle::Options& options, const FaceNames& names,
                  std::span<const PathFlip> flips, std::size_t most_flips, unsigned most_seeds, unsigned threads);

} // namespace clucida::bench
