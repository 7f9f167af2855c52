#include "bench/speed_table.h"

#include "bench/median.h"
#include "bench/precision_name.h"
#include "bench/speed_rank.h"
#include "bench/speed_words.h"
#include "bench/spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <thread>

namespace clucida::bench {
namespace {

constexpr double quiet_share = 0.95; ///< of a processor; with less, others computed at the same time

struct Column {
    std::string head;
    bool is_figure;
    std::function<std::string(const Ranked&)> cell;
};

using Columns = std::vector<Column>;

void add_contender_columns(Columns& to, const std::vector<SpeedContender>& all)
{
    to.push_back({"device", false, [](const Ranked& r) { return place_name(r.report->contender); }});
    to.push_back({"kernel", false, [](const Ranked& r) { return kernel_name(kernel_that_ran(*r.report)); }});
    to.push_back({"precision", false, [](const Ranked& r) { return precision_name(r.report->contender.precision); }});
    to.push_back({"threads", true, [](const Ranked& r) { return thread_count(*r.report); }});
    const auto add = [&](const char* head, const auto& differs, const auto& words) {
        if (std::ranges::any_of(all, differs))
            to.push_back({head, true, [words](const Ranked& r) { return words(r.report->contender); }});
    };
    const host::Shape size = all.empty() ? host::Shape{} : all.front().view.picture;
    using C = const SpeedContender&;
    add(
        "size", [&](C c) { return c.view.picture != size; }, [](C c) { return size_name(c.view.picture); });
    add(
        "samples", [](C c) { return c.view.samples != 1; }, [](C c) { return std::to_string(c.view.samples); });
    add(
        "hops", [](C c) { return c.view.max_hops.has_value(); }, [](C c) { return hops_name(c.view); });
    add(
        "cutoff", [](C c) { return c.view.cutoff.has_value(); }, [](C c) { return cutoff_name(c.view); });
    add(
        "local size", [](C c) { return c.group.has_value(); }, [](C c) { return group_name(c); });
}

void add_time_columns(Columns& to)
{
    const auto add = [&](const char* head, const auto& figure) {
        to.push_back({head, true, [figure](const Ranked& r) { return figure(*r.report); }});
    };
    using R = const SpeedReport&;
    const auto ms = [](double seconds) { return fmt::format("{:.2f}", 1e3 * seconds); };
    const auto rate = [](R r, double count) { return fmt::format("{:.3f}", millions_a_second(r, count)); };
    add("ms", [ms](R r) { return ms(median(r.real)); });
    add("IQR", [ms](R r) { return ms(interquartile_range(r.real)); });
    add("device ms", [ms](R r) { return median(r.kernels) > 0 ? ms(median(r.kernels)) : "-"; });
    add("CPU ms", [ms](R r) { return ms(median(r.cpu)); });
    add("Mrays/s", [rate](R r) { return rate(r, rays_of(r)); });
    add("Mqueries/s", [rate](R r) { return rate(r, static_cast<double>(r.statistics.queries)); });
    add("Mtests/s", [rate](R r) { return rate(r, static_cast<double>(r.statistics.tests)); });
    add("ns/ray", [](R r) { return fmt::format("{:.1f}", nanoseconds_per_ray(r)); });
}

void add_error_columns(Columns& to, const SpeedSettings& settings)
{
    using Errors = std::optional<host::Comparison> SpeedReport::*;
    const auto add = [&](std::string head, Errors errors, double host::Comparison::*which) {
        to.push_back({std::move(head), true, [errors, which](const Ranked& r) {
                          const auto& e = r.report->*errors;
                          return e ? fmt::format("{:.1e}", *e.*which) : "-";
                      }});
    };
    if (settings.error != ErrorFrom::none) {
        add("RMSE, arithmetic", &SpeedReport::arithmetic, &host::Comparison::rmse);
        add("max error", &SpeedReport::arithmetic, &host::Comparison::max_error);
    }
    if (settings.settings_error) {
        add("RMSE, settings", &SpeedReport::settings, &host::Comparison::rmse);
        add("p99.9", &SpeedReport::settings, &host::Comparison::p999);
        add("max error", &SpeedReport::settings, &host::Comparison::max_error);
    }
    if (settings.error != ErrorFrom::none || settings.settings_error)
        to.push_back({"front", false, [](const Ranked& r) { return r.on_front ? "*" : ""; }});
}

void add_other_columns(Columns& to)
{
    const auto add = [&](const char* head, int digits, const auto& figure) {
        to.push_back({head, true, [digits, figure](const Ranked& r) {
                          return fmt::format("{:.{}f}", static_cast<double>(figure(*r.report)), digits);
                      }});
    };
    using R = const SpeedReport&;
    add("ratio", 3, [](R r) { return r.ratio; });
    add("CPU ratio", 3, [](R r) { return r.cpu_ratio; });
    add("build, s", 2, [](R r) { return r.cold.build; });
    add("cached", 2, [](R r) { return r.cached.build; });
    add("first launch, s", 2, [](R r) { return r.cold.first_launch; });
    add("cached", 2, [](R r) { return r.cached.first_launch; });
    add("scene KiB", 1, [](R r) { return static_cast<double>(r.scene_bytes) / 1024; });
    add("peak MiB", 0, [](R r) { return static_cast<double>(r.peak_bytes) * 0x1p-20; });
}

/// The least share of a processor that a contender of one thread had while it traced; 1 if there is none.
double least_share(std::span<const SceneSpeed> results)
{
    double out = 1;
    for (const SceneSpeed& scene : results)
        for (const SpeedReport& r : scene.reports)
            if (r.threads == 1 && !r.real.empty()) out = std::min(out, median(r.cpu) / median(r.real));
    return out;
}

std::string line_of(const std::vector<std::string>& cells)
{
    std::string out = "|";
    for (const std::string& cell : cells) out += " " + cell + " |";
    return out + "\n";
}

} // namespace

Table speed_table(const SceneSpeed& speed, const SpeedSettings& settings)
{
    Columns columns;
    add_contender_columns(columns, settings.contenders);
    const std::size_t figures = columns.size();
    add_time_columns(columns);
    add_error_columns(columns, settings);
    add_other_columns(columns);

    Table out{{"scene"}, {false}, {}};
    for (const Column& c : columns) {
        out.head.push_back(c.head);
        out.is_figure.push_back(c.is_figure);
    }
    for (const Ranked& r : ranked(speed)) {
        std::vector<std::string>& row = out.rows.emplace_back(1, speed.name);
        for (const Column& c : columns) row.push_back(c.cell(r));
    }
    for (const SpeedReport& r : speed.reports) {
        if (r.failure.empty()) continue;
        std::vector<std::string>& row = out.rows.emplace_back(1, speed.name);
        for (std::size_t i = 0; i < figures; ++i) row.push_back(columns[i].cell({&r, false}));
        row.push_back("failed: " + brief(r.failure));
        row.resize(out.head.size(), "-");
    }
    return out;
}

std::string markdown_head(const Table& table)
{
    std::string out = line_of(table.head) + "|";
    for (const bool figure : table.is_figure) out += figure ? "---:|" : "---|";
    return out + "\n";
}

std::string markdown_rows(const Table& table)
{
    std::string out;
    for (const auto& row : table.rows) out += line_of(row);
    return out;
}

std::vector<std::string> speed_notes(std::span<const SceneSpeed> results, const SpeedSettings& settings,
                                     const Load& load)
{
    std::vector<std::string> out;
    const SpeedView view = settings.contenders.empty() ? SpeedView{} : settings.contenders.front().view;
    const auto same = [&](const SpeedContender& c) { return c.view.picture == view.picture; };
    if (std::ranges::all_of(settings.contenders, same)) out.push_back(size_name(view.picture) + " pixels.");
    out.push_back("Ranked: of pictures of one size the fastest first. Time is that of tracing the whole picture as one "
                  "tile and having it back, without compilation and without the scene's way to the device; device is "
                  "what the device itself says that its kernels ran, CPU what all threads of the process computed "
                  "meanwhile.");
    const std::string rounds = settings.most_seconds > 0 && settings.least_rounds < settings.rounds
                                   ? fmt::format("{} to {} rounds (as many as take {:g} s)", settings.least_rounds,
                                                 settings.rounds, settings.most_seconds)
                                   : fmt::format("{} rounds", settings.rounds);
    out.push_back(fmt::format("Medians of {} after one to warm up, IQR their interquartile range. In a round the "
                              "contenders take turns, each device, precision and kernel in a process of its own, and "
                              "render for {:.0f} ms at least; ratios are to the scene's first contender, the median of "
                              "those within each round.",
                              rounds, 1e3 * settings.least_turn));
    out.emplace_back("Rays are all that were traced, shadow rays too; queries are searches for the nearest crossing; "
                     "tests are objects looked at closer than their bounds.");
    out.emplace_back("Build and first launch with an empty cache; cached: in another process with the cache that this "
                     "left. Contenders of one program were compiled once. Scene: its buffers on the device, to which "
                     "16 bytes a pixel come. Peak is the process's memory, without a device's own; contenders that "
                     "differ in size, samples, hops or cutoff only share a process.");
    if (settings.error != ErrorFrom::none && !results.empty())
        out.push_back(fmt::format("Errors of arithmetic: linear light, against {} with the same samples, hops and "
                                  "cutoff, over {} pixels on a regular grid.",
                                  settings.error == ErrorFrom::oracle ? "the oracle" : "the kernel in double",
                                  results.front().compared_pixels));
    if (settings.settings_error && !results.empty())
        out.push_back(fmt::format("Errors of settings: linear light, over all pixels, against a picture of more "
                                  "samples, hops and less cutoff: {}.",
                                  results.front().reference));
    out.push_back(fmt::format("{} processors, with a load of {:.1f} before the start.",
                              std::thread::hardware_concurrency(), load.front()));
    if (const double share = least_share(results); share < quiet_share)
        out.push_back(fmt::format("Not a quiet machine: a contender of one thread had {:.0f} % of a processor. Go by "
                                  "the CPU's times and ratios.",
                                  100 * share));
    std::vector<std::string> told;
    for (const SceneSpeed& scene : results)
        for (const SpeedReport& r : scene.reports) {
            if (!r.failure.empty()) continue;
            const std::string what = is_native(r.contender) ? "native-build: " + r.what : r.what;
            if (std::ranges::find(told, what) == told.end()) told.push_back(what);
            const std::string faults = host::describe_faults(r.statistics);
            if (!faults.empty())
                out.push_back(fmt::format("Faults in {}, {}: {}.", scene.name, describe(r.contender), faults));
        }
    for (const std::string& what : told) out.push_back("- " + what);
    return out;
}

} // namespace clucida::bench
