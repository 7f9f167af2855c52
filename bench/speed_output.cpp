#include "bench/speed_output.h"

#include "bench/error_output.h"
#include "bench/median.h"
#include "bench/spread.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <stdlib.h>

#include <algorithm>
#include <ctime>
#include <thread>

namespace clucida::bench {
namespace {

constexpr double quiet_share = 0.95; ///< of a processor; with less, others computed at the same time

/// Shadow rays too, as `clucida render` counts them.
std::uint64_t rays(const SpeedReport& r)
{
    return r.statistics.rays + r.statistics.shadow;
}

double nanoseconds_per_ray(const SpeedReport& r)
{
    return rays(r) ? 1e9 * median(r.real) / static_cast<double>(rays(r)) : 0;
}

double million_rays_a_second(const SpeedReport& r)
{
    return static_cast<double>(rays(r)) / (1e6 * median(r.real));
}

std::string place(const SpeedContender& c)
{
    return is_native(c) ? "native" : c.device;
}

std::string thread_count(const SpeedReport& r)
{
    return r.threads ? std::to_string(r.threads) : "-";
}

std::string error_name(ErrorFrom from)
{
    switch (from) {
    case ErrorFrom::oracle: return "oracle";
    case ErrorFrom::double_kernel: return "double";
    case ErrorFrom::none: break;
    }
    return "none";
}

std::string error_words(ErrorFrom from)
{
    return from == ErrorFrom::oracle ? "the oracle's" : "that of the kernel in double";
}

std::string kernel_name(const SpeedContender& c)
{
    if (!c.kernel) return "auto";
    return *c.kernel == host::KernelShape::packets ? "packets" : "pixels";
}

/// "-DCLU_PLANE -DCLU_STACK_CAPACITY=8" without what all have in common.
std::string variant_of(const std::string& options)
{
    std::string out;
    for (std::size_t begin = options.find("-DCLU_"); begin != std::string::npos;) {
        const std::size_t end = std::min(options.find(' ', begin), options.size());
        if (!out.empty()) out += ' ';
        out += options.substr(begin + 6, end - begin - 6);
        begin = options.find("-DCLU_", end);
    }
    return out;
}

nlohmann::ordered_json report_json(const SceneSpeed& of, const SpeedReport& r, const SpeedSettings& settings)
{
    const host::Shape size = settings.task.picture;
    const std::string precision = precision_name(r.contender.precision);
    nlohmann::ordered_json j = {{"name", fmt::format("speed/{}/{}/{}/{}/threads:{}/{}x{}", of.name, place(r.contender),
                                                     kernel_name(r.contender), precision,
                                                     r.contender.threads ? std::to_string(r.contender.threads) : "all",
                                                     size.width, size.height)},
                                {"run_type", "iteration"},
                                {"repetitions", settings.rounds},
                                {"iterations", r.pictures},
                                {"real_time", 1e3 * median(r.real)},
                                {"cpu_time", 1e3 * median(r.cpu)},
                                {"time_unit", "ms"},
                                {"real_time_iqr", 1e3 * interquartile_range(r.real)},
                                {"cpu_time_iqr", 1e3 * interquartile_range(r.cpu)},
                                {"ratio", r.ratio},
                                {"ratio_iqr", r.ratio_spread},
                                {"cpu_ratio", r.cpu_ratio},
                                {"scene", of.name},
                                {"device", r.what},
                                {"kernel", kernel_name(r.contender)},
                                {"precision", precision},
                                {"threads", r.threads},
                                {"variant", variant_of(r.options)},
                                {"pixels", host::area(size)},
                                {"samples", settings.task.samples},
                                {"rays", r.statistics.rays},
                                {"shadow_rays", r.statistics.shadow},
                                {"mrays_s", million_rays_a_second(r)},
                                {"ns_per_ray", nanoseconds_per_ray(r)},
                                {"compile_s", r.cold.build},
                                {"first_launch_s", r.cold.first_launch},
                                {"cached_compile_s", r.cached.build},
                                {"cached_first_launch_s", r.cached.first_launch},
                                {"peak_bytes", r.peak_bytes}};
    if (r.error) {
        j["error_from"] = error_name(settings.error);
        j["error_pixels"] = of.compared_pixels;
        j["rmse"] = r.error->rmse;
        j["max_error"] = r.error->max_error;
        j["p999"] = r.error->p999;
        j["not_numbers"] = r.error->not_numbers;
    }
    for (const host::StatisticsField& f : host::statistics_fields())
        if (f.fault) j[f.name] = r.statistics.*f.value;
    j["real_times"] = r.real; // s, each round's
    j["cpu_times"] = r.cpu;
    return j;
}

/// The least share of a processor that a contender of one thread had while it traced; 1 if there is none.
double least_share(std::span<const SceneSpeed> results)
{
    double out = 1;
    for (const SceneSpeed& scene : results)
        for (const SpeedReport& r : scene.reports)
            if (r.threads == 1) out = std::min(out, median(r.cpu) / median(r.real));
    return out;
}

} // namespace

Load machine_load()
{
    Load out{};
    ::getloadavg(out.data(), static_cast<int>(out.size()));
    return out;
}

void print_speed_head(std::FILE* to)
{
    fmt::print(
        to, "| scene | device | kernel | precision | threads | ms | IQR | CPU ms | Mrays/s | ns/ray | RMSE | max error "
            "| ratio | CPU ratio | build, s | cached | first launch, s | cached | peak MiB |\n"
            "|---|---|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
}

void print_speed(std::FILE* to, const SceneSpeed& speed)
{
    for (const SpeedReport& r : speed.reports) {
        const std::string rmse = r.error ? fmt::format("{:.1e}", r.error->rmse) : "-";
        const std::string most = r.error ? fmt::format("{:.1e}", r.error->max_error) : "-";
        fmt::print(
            to,
            "| {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | {:.1f} | {} | {} | {:.3f} | {:.3f} | "
            "{:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} |\n",
            speed.name, place(r.contender), kernel_name(r.contender), precision_name(r.contender.precision),
            thread_count(r), 1e3 * median(r.real), 1e3 * interquartile_range(r.real), 1e3 * median(r.cpu),
            million_rays_a_second(r), nanoseconds_per_ray(r), rmse, most, r.ratio, r.cpu_ratio, r.cold.build,
            r.cached.build, r.cold.first_launch, r.cached.first_launch, static_cast<double>(r.peak_bytes) * 0x1p-20);
    }
}

void print_speed_note(std::FILE* to, std::span<const SceneSpeed> results, const SpeedSettings& settings,
                      const Load& load)
{
    const SpeedTask& task = settings.task;
    fmt::print(to, "\n{}x{}, {} sample{} a pixel. ", task.picture.width, task.picture.height, task.samples,
               task.samples == 1 ? "" : "s");
    fmt::print(to,
               "Time is that of tracing the whole picture as one tile and having it back, without compilation and "
               "without the scene's way to the device; CPU is what all threads of the process computed meanwhile.\n"
               "Medians of {} rounds after one to warm up, IQR their interquartile range. In a round the contenders "
               "take turns, each in a process of its own, and render for {:.0f} ms at least; ratios are to the scene's "
               "first contender, the median of those within each round.\n"
               "Rays are all that were traced, shadow rays too.\n"
               "Build and first launch with an empty cache; cached: in another process with the cache that this "
               "left. Peak is that process's memory, without a device's own.\n",
               settings.rounds, 1e3 * settings.least_turn);
    if (settings.error != ErrorFrom::none && !results.empty())
        fmt::print(to, "RMSE and largest error: linear light, against {}, over {} pixels on a regular grid.\n",
                   error_words(settings.error), results.front().compared_pixels);
    fmt::print(to, "{} processors, with a load of {:.1f} before the start.\n", std::thread::hardware_concurrency(),
               load.front());
    if (const double share = least_share(results); share < quiet_share)
        fmt::print(to,
                   "Not a quiet machine: a contender of one thread had {:.0f} % of a processor. Go by the CPU's times "
                   "and ratios.\n",
                   100 * share);
    std::vector<std::string> told;
    for (const SceneSpeed& scene : results)
        for (const SpeedReport& r : scene.reports) {
            const std::string what = is_native(r.contender) ? "native: " + r.what : r.what;
            if (std::ranges::find(told, what) == told.end()) told.push_back(what);
            const std::string faults = host::describe_faults(r.statistics);
            if (!faults.empty()) fmt::print(to, "Faults in {}, {}: {}.\n", scene.name, describe(r.contender), faults);
        }
    for (const std::string& what : told) fmt::print(to, "- {}\n", what);
}

nlohmann::ordered_json speed_json(std::span<const SceneSpeed> results, const SpeedSettings& settings, const Load& load)
{
    nlohmann::ordered_json out = {{"context",
                                   {{"date", fmt::format("{:%FT%T}Z", fmt::gmtime(std::time(nullptr)))},
                                    {"executable", "clucida-bench"},
                                    {"library_version", CLUCIDA_VERSION},
                                    {"num_cpus", std::thread::hardware_concurrency()},
                                    {"load_avg", load},
                                    {"width", settings.task.picture.width},
                                    {"height", settings.task.picture.height},
                                    {"samples", settings.task.samples},
                                    {"rounds", settings.rounds},
                                    {"error_from", error_name(settings.error)}}},
                                  {"benchmarks", nlohmann::ordered_json::array()}};
    for (const SceneSpeed& scene : results)
        for (const SpeedReport& r : scene.reports) out["benchmarks"].push_back(report_json(scene, r, settings));
    return out;
}

} // namespace clucida::bench
