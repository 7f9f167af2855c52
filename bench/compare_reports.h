/// Two reports of `clucida-bench speed` beside each other: what has become faster or slower.
#pragma once

#include "bench/speed_table.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace clucida::bench {

/// A benchmark that both reports have.
struct ComparedTimes {
    std::string name;
    double old_ms = 0, new_ms = 0;
    double ratio = 1;                         ///< new over old
    double p = 1;                             ///< of the rank test over the rounds' times
    std::optional<double> old_rmse, new_rmse; ///< as the report has them: of the settings, else of the arithmetic
};

struct ReportComparison {
    std::vector<ComparedTimes> both;
    std::vector<std::string> only_old, only_new; ///< names; what failed counts as not there
};

constexpr double significance = 0.01; ///< the greatest p at which a time counts as changed

/// By the benchmarks' names. @throws host::Failure if one is no such report
ReportComparison compare_reports(const nlohmann::ordered_json& old_report, const nlohmann::ordered_json& new_report);

/// @throws host::Failure
nlohmann::ordered_json read_report(const std::string& file);

Table comparison_table(const ReportComparison& comparison);

/// Which times changed, and what only one of the reports has: lines.
std::vector<std::string> comparison_notes(const ReportComparison& comparison);

} // namespace clucida::bench
