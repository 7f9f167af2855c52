/// The error of a scene's pictures against the oracle (docs/numerics.md has the definitions).
#pragma once

#include "bench/costs.h"
#include "bench/flips.h"
#include "bench/kernel_error.h"
#include "bench/truth.h"
#include "host/compare.h"
#include "host/renderer.h"
#include "host/scene_source.h"

#include <functional>
#include <string>
#include <vector>

namespace clucida::bench {

/// Kernels to be judged: in one precision, of one variant (bench/variants.h).
struct Contender {
    host::Precision precision = host::Precision::single;
    std::string variant = "full";
};

struct ErrorSettings {
    host::Shape picture{640, 360};
    std::vector<Contender> contenders{{}};
    RealType oracle = RealType::long_double;
    std::size_t most_explained = 20000; ///< flips that are looked into, of each contender (500 of variants)
    unsigned seeds = 1000;              ///< disturbances that a step is tried in at most (60 of variants)
    unsigned repeats = 3;               ///< pictures that are timed
    bool costs = true;                  ///< also what one rounding, compressed colours, cutoff and hop limit cost
    unsigned threads = 1;               ///< of the oracle
};

/// Numbers that the report calls by these names.
struct ErrorReport {
    Contender contender;
    std::string device;
    double milliseconds = 0, fastest = 0, slowest = 0; ///< a picture without compilation: the median, and the spread
    host::Statistics statistics;                       ///< of one picture
    std::size_t pixels = 0, flips = 0;
    Explained explained;           ///< of the flips
    std::size_t shallow_flips = 0; ///< those that differ within the first four segments
    host::Comparison agreeing;     ///< pixels without a flip, against the oracle with colours as they are stored
    double agreeing_equal = 0;     ///< the share of them whose 8-bit values are all the same
    host::Comparison all;
    double flip = 0; ///< mean FLIP of all pixels
    KernelError kernel;
    host::Picture picture; ///< as the kernels made it
};

struct SceneError {
    std::vector<ErrorReport> reports; ///< of each contender
    host::Picture truth;
    Cost rounding; ///< of every number once
    Cost colors;   ///< filters in 32 bits against exact ones
    Cost cutoff;   ///< against a sixteenth of the cutoff; the first contender's kernels
    Cost hops;     ///< against twice as many hops; likewise
};

/// The flips looked at that are not explained, put in proportion to all.
double unexplained_flips(const ErrorReport& report);

/// progress: 0..1, may be empty. @throws host::Failure, host::UsageError, host::Interrupted, scene::Error
SceneError measure_error(const host::SceneSource& source, const host::Device& device, const ErrorSettings& settings,
                         const std::function<void(double)>& progress);

} // namespace clucida::bench
