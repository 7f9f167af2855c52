/// A report as files: a page that needs no other, Markdown with its plots beside it, JSON.
#pragma once

#include "bench/report_parts.h"
#include "bench/speed_json.h"

#include <filesystem>
#include <string>
#include <vector>

namespace clucida::bench {

struct Report {
    std::vector<host::DeviceInfo> devices; ///< all that OpenCL offers
    std::vector<ReportPart> parts;
    Load load{}; ///< before the start
};

/// In the shape of speed_json(); benchmarks' names begin with their part's instead of "speed", and the context lists
/// the devices.
nlohmann::ordered_json report_json(const Report& report);

/// report.html, report.md, report.json and a file for each plot. @throws host::Failure
void write_report(const std::filesystem::path& folder, const Report& report);

} // namespace clucida::bench
