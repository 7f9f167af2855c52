/// Reports as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace clucida::bench {

/// To the file, or to standard output if that is "-". @throws host::Failure
void write_json(const std::string& file, const nlohmann::ordered_json& report);

} // namespace clucida::bench
