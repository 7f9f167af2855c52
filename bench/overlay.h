/// Kernels of which some files are replaced.
#pragma once

#include "host/kernel_source.h"

#include <vector>

namespace clucida::bench {

/// path, text, path, text, ..., nullptr, as kernels/embed.cmake writes it.
using KernelTable = const char* const*;

/// The first table that has a file wins; what none has is as in the kernels. "full/PATH" is always the kernels' own, so
/// that what replaces a file can include it and change one thing.
host::FileTexts laid_over(std::vector<KernelTable> tables);

} // namespace clucida::bench
