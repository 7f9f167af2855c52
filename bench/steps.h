/// Whether a way of the kernels' holds step by step. Where small mirrors and lenses make more of each rounding hop by
/// hop, the kernels' path is soon far from any that is disturbed but once a hop and traced from the eye: a
/// pseudo-orbit of a chaotic system. So each step is judged from the kernels' own ray.
#pragma once

#include "bench/divergence.h"
#include "bench/faces.h"
#include "host/signatures.h"

#include <string>

namespace clucida::bench {

/// A way (Divergence::way) and the kernels' rays that its segments began with.
struct Trail {
    oracle::Pixel pixel;
    std::vector<Step> way;
    std::vector<host::SegmentRay> rays;
};

/// How far apart two rays start. Origins in the scene's unit of length; directions, of length 1, and throughputs by the
/// length of their difference.
struct Deviation {
    double origin = 0, direction = 0, throughput = 0;
};

/// A step, from one of the kernels' rays to the next; the first is that to the observer's ray.
struct StepVerdict {
    unsigned met = 0; ///< trials, the undisturbed one among them, in which the oracle's step was the kernels'
    Deviation off;    ///< of the kernels' next ray from the oracle's undisturbed one (else from the mean of those met)
    Deviation reach;  ///< the most by which a disturbed one of the oracle's is off
    bool holds = false;
};

struct Verdict {
    std::vector<StepVerdict> steps; ///< the observer's ray, then the way's segments
    bool holds() const;
};

/// A step holds if the oracle, from the kernels' ray, goes on as they do (`goes`), undisturbed or in one of the
/// disturbances 1 ... most_seeds (bench/disturbances.h), and if their next ray is no farther off than these take the
/// oracle's: in origin, in direction and in throughput. Disturbances are tried until all steps hold.
/// @throws host::Interrupted
std::vector<Verdict> judge_steps(const scene::Scene& scene, const oracle::Options& options, const FaceNames& names,
                                 std::span<const Trail> trails, unsigned most_seeds, unsigned threads);

/// The first step that does not hold, and why; empty if all do.
std::string why_not(const Verdict& verdict);

} // namespace clucida::bench
