#include "bench/write_json.h"

#include "host/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace clucida::bench {

void write_json(const std::string& file, const nlohmann::ordered_json& report)
{
    const std::string text = report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    if (file == "-")
        fmt::print("{}", text);
    else
        host::write_file(file, text);
}

} // namespace clucida::bench
