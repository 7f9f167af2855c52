/// What `clucida-bench speed` tells: a Markdown table, and JSON.
#pragma once

#include "bench/measure_speed.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdio>

namespace clucida::bench {

/// How many processes wanted to compute, in the mean of 1, 5 and 15 minutes.
using Load = std::array<double, 3>;

/// As it is now: asked before anything is measured, for what is measured adds to it.
Load machine_load();

/// The table's head.
void print_speed_head(std::FILE* to);

/// A scene's rows, one for each contender.
void print_speed(std::FILE* to, const SceneSpeed& speed);

/// What was measured, on how busy a machine, and what the contenders are.
void print_speed_note(std::FILE* to, std::span<const SceneSpeed> results, const SpeedSettings& settings,
                      const Load& load);

/// In Google Benchmark's shape: "context" and "benchmarks".
nlohmann::ordered_json speed_json(std::span<const SceneSpeed> results, const SpeedSettings& settings, const Load& load);

} // namespace clucida::bench
