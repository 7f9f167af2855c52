#include "bench/variants.h"

#include <stdexcept>

extern const char* const clucida_variant_naive_table[]; // made by kernels/embed.cmake
extern const char* const clucida_variant_reoriginated_table[];

namespace clucida::bench {
namespace {

using Table = const char* const*;

std::optional<std::string_view> find_text(Table table, const std::string& path)
{
    for (Table entry = table; *entry; entry += 2)
        if (path == entry[0]) return entry[1];
    return std::nullopt;
}

/// The first table that has a file wins; what none has is as in the kernels.
host::FileTexts laid_over(std::vector<Table> tables)
{
    return [tables = std::move(tables)](const std::string& path) {
        for (const Table table : tables)
            if (const auto text = find_text(table, path)) return text;
        return host::embedded_kernel(path);
    };
}

} // namespace

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
