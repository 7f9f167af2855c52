/// Where the time of a scene's picture goes: all that `clucida-bench profile` measures.
#pragma once

#include "bench/fixed_costs.h"
#include "bench/path_lengths.h"
#include "bench/profile_code.h"
#include "bench/time_ablations.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace clucida::bench {

/// What is to be measured.
struct ProfileParts {
    bool counts = true, times = true, fixed = true, code = true, executed = true;
};

struct ProfileSettings {
    host::Shape picture{320, 180};
    host::Precision precision = host::Precision::single;
    std::optional<host::KernelShape> kernel; ///< else the one that is made for the device
    unsigned rounds = 9;
    host::Shape executed_picture{160, 90}; ///< under Valgrind, which takes some 500 times as long
    std::string compiler;                  ///< of the native build; else clang, else cc
    std::size_t path_pixels = 4000, error_pixels = 1000;
    unsigned oracle_threads = 1;
    ProfileParts parts;
};

/// An ablation, and how far its picture is from the oracle's where it claims to be right.
struct ProfileTime {
    AblationTime time;
    std::optional<host::Comparison> error;
};

/// What a processor can do at most.
struct Peaks {
    double flops = 0; ///< of one of the device's, in the precision, a second
    double clock = 0; ///< cycles a second; 0: not known
};

struct SceneProfile {
    std::string name;
    host::KernelShape kernel = host::KernelShape::pixels;
    std::size_t objects = 0;
    host::Statistics counted; ///< of the picture
    std::uint64_t nodes = 0;  ///< opened on walks through the tree, once for each ray
    PathLengths paths;
    std::vector<ProfileTime> times; ///< the first is the whole
    FixedCosts fixed;
    std::size_t coordinate_bytes = 0, node_bytes = 0; ///< of the scene's
    std::vector<StaticCode> code;                     ///< the device's, and the native build's
    std::optional<ExecutedPicture> executed;
    Peaks peaks;
    std::vector<std::string> notes; ///< why something is missing
};

/// progress: 0..1.
/// @throws host::Failure, host::UsageError, host::Interrupted, scene::Error
SceneProfile measure_profile(const host::SceneOptions& scene, const host::Device& device,
                             const ProfileSettings& settings, const std::function<void(double)>& progress);

} // namespace clucida::bench
