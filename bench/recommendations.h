/// What to render with, for several errors at once.
#pragma once

#include "bench/measure_speed.h"
#include "bench/speed_table.h"

#include <array>
#include <span>

namespace clucida::bench {

/// What reports recommend for: RMSE in linear light.
inline constexpr std::array recommended_errors{0.03, 0.01, 0.003};

/// A row for each scene and size, a column for each of those errors: the fastest settings that keep it, with their
/// time. No rows if no error is known.
Table recommendation_table(std::span<const SceneSpeed> results, std::span<const double> errors);

} // namespace clucida::bench
