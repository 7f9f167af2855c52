/// Contenders race over a scene's picture: they take turns, each in a process of its own.
#pragma once

#include "bench/speed_task.h"
#include "host/compare.h"
#include "host/statistics.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clucida::bench {

/// What pictures are held against.
enum class ErrorFrom { none, oracle, double_kernel };

struct SpeedSettings {
    SpeedTask task; ///< of all contenders; its scene and contender are of no account
    std::vector<SpeedContender> contenders;
    unsigned rounds = 9;
    double least_turn = 0.05; ///< s of pictures that a contender's turn in a round takes at least
    ErrorFrom error = ErrorFrom::oracle;
    std::size_t error_pixels = 1000;
    unsigned oracle_threads = 1;
    std::string reference_device; ///< P:D, of the double kernel's picture
};

/// What it takes to have a program, s.
struct Readying {
    double build = 0;        ///< compilation or, if the cache has it, loading
    double first_launch = 0; ///< code generation, where it is put off until then
};

struct SpeedReport {
    SpeedContender contender;
    std::string what, options;     ///< the device or the compiler; what selects the variant of the kernels
    unsigned threads = 0;          ///< as the device says; 0: it has none to speak of
    Readying cold, cached;         ///< with an empty cache; with one that has the program
    std::vector<double> real, cpu; ///< of a picture's tracing, s: each round's
    std::size_t pictures = 0;      ///< rendered in these rounds
    host::Statistics statistics;   ///< of one picture
    std::uint64_t peak_bytes = 0;  ///< of the process that rendered and did not compile
    std::optional<host::Comparison> error;
    double ratio = 1, cpu_ratio = 1; ///< to the first contender: the median of the rounds' ratios
    double ratio_spread = 0;         ///< their interquartile range
};

/// "0:0 float, 2 threads", "native double"
std::string describe(const SpeedContender& contender);

struct SceneSpeed {
    std::string name;
    std::vector<SpeedReport> reports; ///< of each contender
    std::size_t compared_pixels = 0;
};

/// progress: 0..1. @throws host::Failure, host::UsageError, host::Interrupted, scene::Error
SceneSpeed measure_speed(const host::SceneOptions& scene, const SpeedSettings& settings,
                         const std::function<void(double)>& progress);

} // namespace clucida::bench
