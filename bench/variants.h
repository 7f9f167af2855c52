/// Variants of the kernels' numerics, to be measured against each other.
#pragma once

#include "host/kernel_source.h"

#include <string>
#include <vector>

namespace clucida::bench {

inline const std::string full_variant = "full"; ///< the kernels as they are

/// "naive" (textbook formulas and a global epsilon), "reoriginated" (those, at the point nearest to the object) and
/// "full" (the kernels as they are).
std::vector<std::string> variant_names();

/// The kernels' text with the files that the variant replaces (bench/variants/).
/// @throws std::invalid_argument if there is no such variant
host::FileTexts variant_kernels(const std::string& name);

} // namespace clucida::bench
