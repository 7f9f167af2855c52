#include "bench/variants.h"

#include "bench/overlay.h"

#include <stdexcept>

extern const char* const clucida_variant_naive_table[]; // made by kernels/embed.cmake
extern const char* const clucida_variant_reoriginated_table[];

namespace clucida::bench {

std::vector<std::string> variant_names()
{
    return {"naive", "reoriginated", full_variant};
}

host::FileTexts variant_kernels(const std::string& name)
{
    if (name == "naive") return laid_over({clucida_variant_naive_table});
    if (name == "reoriginated") return laid_over({clucida_variant_reoriginated_table, clucida_variant_naive_table});
    if (name == full_variant) return host::embedded_kernel;
    throw std::invalid_argument("there is no variant " + name + " of the kernels");
}

} // namespace clucida::bench
