/// What `clucida-bench speed` tells: a Markdown table, and JSON.
#pragma once

#include "bench/measure_speed.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdio>

namespace clucida::bench {

/// The table's head.
void print_speed_head(std::FILE* to);

/// A scene's rows, one for each contender.
void print_speed(std::FILE* to, const SceneSpeed& speed);

/// What was measured, and what the contenders are.
void print_speed_note(std::FILE* to, std::span<const SceneSpeed> results, const SpeedSettings& settings);

/// In Google Benchmark's shape: "context" and "benchmarks".
nlohmann::ordered_json speed_json(std::span<const SceneSpeed> results, const SpeedSettings& settings);

} // namespace clucida::bench
