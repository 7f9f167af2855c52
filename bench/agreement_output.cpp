#include "bench/agreement_output.h"

#include "bench/precision_name.h"
#include "bench/speed_words.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ctime>
#include <vector>

namespace clucida::bench {
namespace {

/// All scenes of one place and way.
struct Row {
    const SceneAgreement* first;
    Agreement agreement;
    std::size_t scenes = 0, failed = 0;
    std::string failure = {}; ///< the last
};

bool same_row(const SceneAgreement& a, const SceneAgreement& b)
{
    return a.place == b.place && a.way == b.way;
}

std::vector<Row> rows_of(std::span<const SceneAgreement> results)
{
    std::vector<Row> rows;
    for (const SceneAgreement& r : results) {
        auto row = rows.begin();
        while (row != rows.end() && !same_row(*row->first, r)) ++row;
        if (row == rows.end()) row = rows.insert(rows.end(), Row{&r, {}});
        row->scenes++;
        row->failed += !r.failure.empty();
        if (!r.failure.empty()) row->failure = r.failure;
        row->agreement = united(row->agreement, r.agreement);
    }
    return rows;
}

double equal_share(const Agreement& a)
{
    return a.values ? static_cast<double>(a.equal) / static_cast<double>(a.values) : 0;
}

/// Without the place, which stands beside it.
std::string failure_cell(const Row& row)
{
    const std::string place = row.first->place + ": ";
    return brief(row.failure.starts_with(place) ? row.failure.substr(place.size()) : row.failure);
}

std::string worth_telling(const SceneAgreement& r)
{
    if (!r.failure.empty()) return r.failure;
    std::string out;
    const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
    if (r.agreement.flips) add(fmt::format("{} of {} paths differ", r.agreement.flips, r.agreement.paths));
    if (r.agreement.over)
        add(fmt::format("{} pixels differ by up to {} steps", r.agreement.over, r.agreement.most_steps));
    if (!r.faults.empty()) add("faults: " + r.faults);
    return out;
}

} // namespace

double flips_per_million(const Agreement& a)
{
    return a.paths ? 1e6 * static_cast<double>(a.flips) / static_cast<double>(a.paths) : 0;
}

void print_agreement(std::FILE* to, std::span<const SceneAgreement> results, host::Shape size)
{
    fmt::print(to, "| device | precision | kernel | scenes | failed | equal values | most ulps | most 8-bit steps "
                   "| pixels > 1 step | flips per million | differ, same path |\n"
                   "|---|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const Row& row : rows_of(results)) {
        const Agreement& a = row.agreement;
        fmt::print(to, "| {} | {} | {} | {} | {} ", row.first->place, precision_name(row.first->way.precision),
                   kernel_name(row.first->way.kernel), row.scenes, row.failed);
        if (row.failed == row.scenes) {
            fmt::print(to, "| {} | - | - | - | - | - |\n", failure_cell(row));
            continue;
        }
        fmt::print(to, "| {:.4f} % | {} | {} | {} | {} | {} |\n", 100 * equal_share(a), a.most_ulps, a.most_steps,
                   a.over, a.paths ? fmt::format("{:.1f}", flips_per_million(a)) : "-",
                   a.paths ? fmt::format("{}", a.other) : "-");
    }
    if (results.empty()) return;
    fmt::print(to,
               "\n{}x{}; every device beside the first, by the same kernel in the same precision. Equal values: "
               "linear floats of the same bits.\n",
               size.width, size.height);
    std::vector<std::string> told;
    for (const SceneAgreement& r : results) {
        if (!r.device.empty() && std::ranges::find(told, r.place) == told.end()) {
            told.push_back(r.place);
            fmt::print(to, "- {}: {}\n", r.place, r.device);
        }
        if (const std::string text = worth_telling(r); !text.empty())
            fmt::print(to, "- {}, {} in {} by {}: {}\n", r.scene, r.place, precision_name(r.way.precision),
                       kernel_name(r.way.kernel), text);
    }
}

nlohmann::ordered_json agreement_json(std::span<const SceneAgreement> results, host::Shape size)
{
    nlohmann::ordered_json out = {{"context",
                                   {{"date", fmt::format("{:%FT%T}Z", fmt::gmtime(std::time(nullptr)))},
                                    {"executable", "clucida-bench"},
                                    {"library_version", CLUCIDA_VERSION},
                                    {"width", size.width},
                                    {"height", size.height}}},
                                  {"benchmarks", nlohmann::ordered_json::array()}};
    for (const SceneAgreement& r : results) {
        const Agreement& a = r.agreement;
        nlohmann::ordered_json j = {
            {"name", fmt::format("agreement/{}/{}/{}/{}/{}x{}", r.scene, r.place, kernel_name(r.way.kernel),
                                 precision_name(r.way.precision), size.width, size.height)},
            {"run_type", "iteration"},
            {"scene", r.scene},
            {"place", r.place},
            {"device", r.device},
            {"kernel", kernel_name(r.way.kernel)},
            {"precision", precision_name(r.way.precision)},
            {"pixels", a.pixels},
            {"equal_share", equal_share(a)},
            {"most_ulps", a.most_ulps},
            {"most_steps", a.most_steps},
            {"pixels_over_a_step", a.over},
            {"paths", a.paths},
            {"flips", a.flips},
            {"flips_ppm", flips_per_million(a)},
            {"differ_on_same_path", a.other},
            {"faults", r.faults}};
        if (!r.failure.empty()) {
            j["error_occurred"] = true;
            j["error_message"] = r.failure;
        }
        out["benchmarks"].push_back(std::move(j));
    }
    return out;
}

} // namespace clucida::bench
