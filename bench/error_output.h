/// What `clucida-bench error` tells: for people, as Markdown tables, as JSON.
#pragma once

#include "bench/measure_error.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdio>

namespace clucida::bench {

/// One scene's results, and under which name.
struct NamedError {
    std::string scene;
    SceneError error;
};

void print_error(std::FILE* to, const NamedError& result, const ErrorSettings& settings);

/// Two tables over all scenes: every contender's error, and what a scene's settings cost.
void print_tables(std::FILE* to, std::span<const NamedError> results, const ErrorSettings& settings);

/// In Google Benchmark's shape: "context" and "benchmarks".
nlohmann::ordered_json error_json(std::span<const NamedError> results, const ErrorSettings& settings,
                                  const std::string& oracle);

} // namespace clucida::bench
