/// Path flips: pixels whose path is not the oracle's, and whether rounding explains them.
#pragma once

#include "bench/divergence.h"
#include "bench/faces.h"
#include "host/signatures.h"

#include <cstddef>
#include <functional>
#include <string>

namespace clucida::bench {

struct PathFlip {
    oracle::Pixel pixel;
    std::vector<Divergence> divergences; ///< of the kernels' path from the oracle's, not empty
};

/// A flip that nothing explains, and the first step that does not hold.
struct UnexplainedFlip {
    oracle::Pixel pixel;
    std::string why;
};

struct Explained {
    std::size_t looked_at = 0, explained = 0; ///< flips
    std::size_t step_by_step = 0;             ///< of the explained: those whose paths only hold step by step
    std::vector<UnexplainedFlip> unexplained;
};

/// The kernels' paths of pixels, whole, with their rays.
using PathsOf = std::function<std::vector<host::PixelPath>(std::span<const oracle::Pixel>)>;

/// A flip is explained if for each of its divergences the oracle goes the kernels' way when the scene and its rays are
/// disturbed by at most 4u (bench/disturbances.h): on the whole path from the eye, or else on each step of it from the
/// kernels' own ray (bench/steps.h). Looks into so many flips at most, chosen evenly. Whole paths are tried in the
/// first few disturbances, steps in up to most_seeds. @throws host::Interrupted
Explained explain(const scene::Scene& scene, const oracle::Options& options, const FaceNames& names,
                  std::span<const PathFlip> flips, const PathsOf& paths_of, std::size_t most_flips, unsigned most_seeds,
                  unsigned threads);

} // namespace clucida::bench
