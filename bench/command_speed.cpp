#include "bench/commands.h"
#include "bench/compare_reports.h"
#include "bench/speed_calibration.h"
#include "bench/speed_files.h"
#include "bench/speed_options.h"
#include "bench/speed_rank.h"
#include "bench/speed_words.h"
#include "bench/write_json.h"
#include "host/atomic_file.h"
#include "host/progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace clucida::bench {
namespace {

/// A limit that a device makes nothing of would make its row a lie.
void warn_of_threads(const SceneSpeed& speed)
{
    for (const SpeedReport& r : speed.reports)
        if (r.failure.empty() && r.contender.threads && r.threads != r.contender.threads)
            fmt::print(stderr, "clucida-bench: warning: {}: the device has {} threads, not as many as asked for\n",
                       describe(r.contender), r.threads);
}

/// What cannot be written is told before anything is measured.
void require_outputs(const SpeedOptions& o)
{
    for (const std::string* file : {&o.json, &o.csv, &o.html})
        if (!file->empty() && *file != "-") host::require_writable(*file);
    if (!o.svg.empty()) require_folder(o.svg);
}

void print_recommendations(std::FILE* to, const std::vector<SceneSpeed>& results, double max_error)
{
    fmt::print(to, "\n");
    for (const SceneSpeed& scene : results)
        for (const Recommendation& r : recommend(scene, max_error))
            fmt::print(to, "- {}\n", describe(r, scene, max_error));
}

void print_comparison(std::FILE* to, const ReportComparison& comparison)
{
    const Table table = comparison_table(comparison);
    fmt::print(to, "\n{}{}", markdown_head(table), markdown_rows(table));
    for (const std::string& note : comparison_notes(comparison)) fmt::print(to, "\n{}\n", note);
}

void write_outputs(const SpeedOptions& o, const std::vector<SceneSpeed>& results, const SpeedSettings& settings,
                   const Load& load, const nlohmann::ordered_json& json)
{
    if (!o.json.empty()) write_json(o.json, json);
    if (!o.csv.empty()) host::write_file(o.csv, benchmarks_csv(json));
    if (!o.html.empty()) host::write_file(o.html, speed_page(results, settings, load));
    if (o.svg.empty()) return;
    DeviceColors colors;
    write_plots(o.svg, speed_plots(results, colors, PlotUse::file));
}

void run(const SpeedOptions& o)
{
    const std::vector<host::DeviceInfo> devices = devices_of(o);
    const SpeedSettings settings = settings_of(o, devices);
    std::optional<nlohmann::ordered_json> before;
    if (!o.compare.empty()) before = read_report(o.compare);
    require_outputs(o);
    std::FILE* const to = o.json == "-" ? stderr : stdout;
    if (!o.quiet)
        fmt::print(stderr, "{} contender{} for each of {} scene{}\n", settings.contenders.size(),
                   settings.contenders.size() == 1 ? "" : "s", o.scenes.size(), o.scenes.size() == 1 ? "" : "s");
    const Load load = machine_load();
    std::vector<SceneSpeed> results;
    for (const std::string& file : o.scenes) {
        {
            host::ProgressBar bar(file, !o.quiet);
            results.push_back(measure_speed({file, o.format, o.allow_path, o.as_original}, settings,
                                            [&](double done) { bar.update(done); }));
        }
        warn_of_threads(results.back());
        const Table table = speed_table(results.back(), settings);
        fmt::print(to, "{}{}", results.size() == 1 ? markdown_head(table) : "", markdown_rows(table));
        std::fflush(to);
    }
    fmt::print(to, "\n");
    for (const std::string& note : speed_notes(results, settings, load)) fmt::print(to, "{}\n", note);
    if (o.max_error) print_recommendations(to, results, *o.max_error);
    const nlohmann::ordered_json json = speed_json(results, settings, load);
    if (before) print_comparison(to, compare_reports(*before, json));
    write_outputs(o, results, settings, load, json);
    if (o.calibrate) store_calibrations(results, devices, o.quiet);
}

} // namespace

void add_speed(CLI::App& app)
{
    auto options = std::make_shared<SpeedOptions>();
    CLI::App* command = app.add_subcommand("speed", "How fast pictures are traced, and how far they are from right");
    add_speed_options(*command, *options);
    command->footer(
        "Examples:\n"
        "  clucida-bench speed scene.clu\n"
        "  clucida-bench speed scenes/*.clu -s 320x180 --threads 1,all --native\n"
        "  clucida-bench speed scene.clu --device pocl --device gpu --precision both --json speed.json\n"
        "  clucida-bench speed scene.clu --kernel pixels --local-size auto,8x8,32x2 --compare speed.json\n"
        "  clucida-bench speed scene.clu --samples 1,4,16 --max-hops 4,scene --max-error 0.01\n"
        "  clucida-bench speed scene.clu --samples 1,4,16 --precision both --calibrate\n"
        "  clucida-bench speed scene.gun --as-original --rounds 25\n"
        "\nEach option with a list multiplies the contenders. The first contender is the one that ratios are to.\n"
        "docs/user-guide.md says what the figures mean.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::bench
