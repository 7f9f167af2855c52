/// The kernels to compare.
#pragma once

#include "host/kernel_source.h"

#include <string>
#include <vector>

namespace clucida::bench {

inline const std::string full_variant = "full";

inline std::vector<std::string> variant_names()
{
    return {full_variant};
}
inline host::FileTexts variant_kernels(const std::string&)
{
    return host::embedded_kernel;
}

} // namespace clucida::bench
