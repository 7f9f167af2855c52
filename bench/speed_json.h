/// What `clucida-bench speed` measured, for other programs.
#pragma once

#include "bench/measure_speed.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <span>
#include <string>

namespace clucida::bench {

/// How many processes wanted to compute, in the mean of 1, 5 and 15 minutes.
using Load = std::array<double, 3>;

/// As it is now: asked before anything is measured, for what is measured adds to it.
Load machine_load();

/// In Google Benchmark's shape: "context" and "benchmarks". A contender that failed has "error_occurred" and
/// "error_message" instead of figures.
nlohmann::ordered_json speed_json(std::span<const SceneSpeed> results, const SpeedSettings& settings, const Load& load);

/// The benchmarks' figures as comma-separated values (RFC 4180), a line each beneath a line of names; lists, such as
/// the times of all rounds, are left out.
std::string benchmarks_csv(const nlohmann::ordered_json& report);

/// "oracle", "double" or "none"
std::string error_name(ErrorFrom from);

} // namespace clucida::bench
