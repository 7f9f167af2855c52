/// Contenders race over a scene's picture: they take turns, in processes that are theirs.
#pragma once

#include "bench/speed_task.h"
#include "host/compare.h"
#include "host/statistics.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace clucida::bench {

/// What pictures are held against to tell the arithmetic's error, with the same settings.
enum class ErrorFrom { none, oracle, double_kernel };

/// What it takes to have a program, s.
struct Readying {
    double build = 0;        ///< compilation or, if the cache has it, loading
    double first_launch = 0; ///< code generation, where it is put off until then
};

/// A program that a race has compiled, and what finds it there.
struct CompiledProgram {
    std::string scene; ///< file
    SpeedContender contender;
    std::filesystem::path folder; ///< of caches
    Readying cold;
};

/// Programs that one race leaves to the next, in folders beneath one that stays.
struct CompiledPrograms {
    std::filesystem::path folder;
    std::vector<CompiledProgram> programs = {};
    std::size_t folders = 0; ///< made so far
};

struct SpeedSettings {
    std::vector<SpeedContender> contenders;
    NativeBuild native; ///< of native contenders; its folder is of no account
    unsigned rounds = 9;
    unsigned least_rounds = 3; ///< that a slow contender takes part in
    double least_turn = 0.05;  ///< s of pictures that a contender's turn in a round takes at least
    double most_seconds = 0;   ///< after which a contender takes no further turn, if it had its least; 0: no end
    double most_opening = 0;   ///< s that a contender's process may take to compile and load its program; 0: no end
    bool keep_going = false;   ///< a contender that fails is a report that says so
    ErrorFrom error = ErrorFrom::oracle;
    bool settings_error = false;     ///< also the error of samples, hops and cutoff (reference.h)
    std::size_t error_pixels = 1000; ///< of the arithmetic's error
    unsigned oracle_threads = 1;
    CompiledPrograms* compiled = nullptr; ///< of races before this one; else each begins with nothing
    std::string reference_device;         ///< P:D, of pictures that others are held against
    host::Precision reference_precision = host::Precision::twofold;
};

struct SpeedReport {
    SpeedContender contender;
    std::string failure;       ///< if not empty nothing was measured: it says why
    std::string what, options; ///< the device or the compiler; what selects the variant of the kernels
    host::KernelShape kernel = host::KernelShape::pixels; ///< that ran
    unsigned threads = 0;                                 ///< as the device says; 0: it has none to speak of
    std::size_t objects = 0;                              ///< of the scene
    Readying cold, cached;                                ///< with an empty cache; with one that has the program
    std::vector<double> real, cpu;                        ///< of a picture's tracing, s: each round's
    std::vector<double> kernels;                ///< that the device says its kernels ran, s; 0: it does not say
    std::size_t pictures = 0;                   ///< rendered in these rounds
    host::Statistics statistics;                ///< of one picture
    std::uint64_t scene_bytes = 0;              ///< of the buffers on the device
    std::uint64_t peak_bytes = 0;               ///< of the process that rendered and did not compile
    std::optional<host::Comparison> arithmetic; ///< against the same settings, over some pixels
    std::optional<host::Comparison> settings;   ///< against the reference, over all pixels
    double ratio = 1, cpu_ratio = 1;            ///< to the first contender: the median of the rounds' ratios
    double ratio_spread = 0;                    ///< their interquartile range
};

/// "0:0 float, 2 threads", "native-build double"
std::string describe(const SpeedContender& contender);

struct SceneSpeed {
    std::string name, file;
    std::string hash;                 ///< SHA-256 of the text
    std::vector<SpeedReport> reports; ///< of each contender
    std::size_t compared_pixels = 0;  ///< for the arithmetic's error
    std::string reference;            ///< what the settings' error is against; empty: nothing
};

/// progress: 0..1. @throws host::Failure, host::UsageError, host::Interrupted, scene::Error
SceneSpeed measure_speed(const host::SceneOptions& scene, const SpeedSettings& settings,
                         const std::function<void(double)>& progress);

} // namespace clucida::bench
