#include "bench/compare_reports.h"

#include "bench/rank_test.h"
#include "host/atomic_file.h"
#include "host/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace clucida::bench {
namespace {

using Json = nlohmann::ordered_json;

std::optional<double> rmse_of(const Json& b)
{
    for (const char* key : {"settings_rmse", "rmse"})
        if (const auto at = b.find(key); at != b.end() && at->is_number()) return at->get<double>();
    return std::nullopt;
}

bool was_measured(const Json& b)
{
    return b.contains("real_time");
}

const Json* find(const Json& report, const std::string& name)
{
    for (const Json& b : report.at("benchmarks"))
        if (was_measured(b) && b.at("name") == name) return &b;
    return nullptr;
}

ComparedTimes compared(const Json& before, const Json& after)
{
    ComparedTimes out;
    out.name = before.at("name");
    out.old_ms = before.at("real_time");
    out.new_ms = after.at("real_time");
    out.ratio = out.new_ms / out.old_ms;
    out.p = rank_test(before.at("real_times").get<std::vector<double>>(),
                      after.at("real_times").get<std::vector<double>>());
    out.old_rmse = rmse_of(before);
    out.new_rmse = rmse_of(after);
    return out;
}

bool is_changed(const ComparedTimes& c)
{
    return c.p <= significance;
}

std::string rmse_text(const std::optional<double>& rmse)
{
    return rmse ? fmt::format("{:.1e}", *rmse) : "-";
}

void add_names(std::vector<std::string>& to, const char* what, const std::vector<std::string>& names)
{
    for (const std::string& name : names) to.push_back(fmt::format("Only in the {}: {}", what, name));
}

} // namespace

Json read_report(const std::string& file)
{
    Json report = Json::parse(host::read_file(file), nullptr, false);
    if (report.is_discarded() || !report.is_object() || !report.contains("benchmarks"))
        throw host::Failure(file + " is no report of `clucida-bench speed --json`");
    return report;
}

ReportComparison compare_reports(const Json& old_report, const Json& new_report)
{
    try {
        ReportComparison out;
        for (const Json& b : old_report.at("benchmarks")) {
            if (!was_measured(b)) continue;
            if (const Json* after = find(new_report, b.at("name")))
                out.both.push_back(compared(b, *after));
            else
                out.only_old.push_back(b.at("name"));
        }
        for (const Json& b : new_report.at("benchmarks"))
            if (was_measured(b) && !find(old_report, b.at("name"))) out.only_new.push_back(b.at("name"));
        return out;
    } catch (const nlohmann::json::exception& e) {
        throw host::Failure(
            fmt::format("a report to compare with lacks what `clucida-bench speed` writes: {}", e.what()));
    }
}

Table comparison_table(const ReportComparison& comparison)
{
    Table out{{"benchmark", "old ms", "new ms", "new / old", "p", "old RMSE", "new RMSE", "changed"},
              {false, true, true, true, true, true, true, false},
              {}};
    for (const ComparedTimes& c : comparison.both)
        out.rows.push_back({c.name, fmt::format("{:.2f}", c.old_ms), fmt::format("{:.2f}", c.new_ms),
                            fmt::format("{:.3f}", c.ratio), fmt::format("{:.2g}", c.p), rmse_text(c.old_rmse),
                            rmse_text(c.new_rmse),
                            !is_changed(c) ? ""
                            : c.ratio < 1  ? "faster"
                                           : "slower"});
    return out;
}

std::vector<std::string> comparison_notes(const ReportComparison& comparison)
{
    const std::vector<ComparedTimes>& all = comparison.both;
    const auto faster = std::ranges::count_if(all, [](const auto& c) { return is_changed(c) && c.ratio < 1; });
    const auto slower = std::ranges::count_if(all, is_changed) - faster;
    std::vector<std::string> out{fmt::format(
        "Of {} benchmarks in both {} became significantly faster and {} slower: p of at most {} by the two-sided test "
        "of Mann and Whitney over the rounds' times. As many as {:.1f} would by chance. Three rounds are too few for "
        "any, five for a p below 0.0079.",
        all.size(), faster, slower, significance, significance * static_cast<double>(all.size()))};
    add_names(out, "old", comparison.only_old);
    add_names(out, "new", comparison.only_new);
    return out;
}

} // namespace clucida::bench
