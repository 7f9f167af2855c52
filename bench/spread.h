/// How far numbers lie apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace clucida::bench {

/// The number that a share of the values lies below, between neighbours in proportion. values is not empty.
inline double quantile(std::vector<double> values, double share)
{
    std::ranges::sort(values);
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - std::floor(place));
}

/// The interquartile range: the middle half of the values lies within as much. values is not empty.
inline double interquartile_range(const std::vector<double>& values)
{
    return quantile(values, 0.75) - quantile(values, 0.25);
}

} // namespace clucida::bench
