#include "bench/overlay.h"

#include <string_view>

namespace clucida::bench {
namespace {

constexpr std::string_view own = "full/";

std::optional<std::string_view> find_text(KernelTable table, const std::string& path)
{
    for (KernelTable entry = table; *entry; entry += 2)
        if (path == entry[0]) return entry[1];
    return std::nullopt;
}

} // namespace

host::FileTexts laid_over(std::vector<KernelTable> tables)
{
    return [tables = std::move(tables)](const std::string& path) {
        if (path.starts_with(own)) return host::embedded_kernel(path.substr(own.size()));
        for (const KernelTable table : tables)
            if (const auto text = find_text(table, path)) return text;
        return host::embedded_kernel(path);
    };
}

} // namespace clucida::bench
