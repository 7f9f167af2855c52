/// The middle of some numbers; of an even count the larger of the two in the middle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace clucida::bench {

/// values is not empty.
inline double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace clucida::bench
