#include "bench/speed_json.h"

#include "bench/median.h"
#include "bench/precision_name.h"
#include "bench/speed_words.h"
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

using Json = nlohmann::ordered_json;

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

Json contender_json(const SceneSpeed& of, const SpeedReport& r)
{
    const SpeedView& view = r.contender.view;
    Json j = {{"name", benchmark_name(of.name, r.contender)}, {"run_type", "iteration"}, {"scene", of.name}};
    j["device"] = r.what.empty() ? place_name(r.contender) : r.what;
    j["kernel"] = kernel_name(r.contender.kernel);
    j["precision"] = precision_name(r.contender.precision);
    j["threads"] = r.threads;
    j["width"] = view.picture.width;
    j["height"] = view.picture.height;
    j["pixels"] = host::area(view.picture);
    j["samples"] = view.samples;
    j["max_hops"] = view.max_hops ? Json(*view.max_hops) : nullptr;
    j["cutoff"] = view.cutoff ? Json(*view.cutoff) : nullptr;
    j["local_size"] = group_name(r.contender);
    return j;
}

void add_times(Json& j, const SpeedReport& r)
{
    j["repetitions"] = r.real.size();
    j["iterations"] = r.pictures;
    j["real_time"] = 1e3 * median(r.real);
    j["cpu_time"] = 1e3 * median(r.cpu);
    j["time_unit"] = "ms";
    j["real_time_iqr"] = 1e3 * interquartile_range(r.real);
    j["cpu_time_iqr"] = 1e3 * interquartile_range(r.cpu);
    if (const double kernels = median(r.kernels); kernels > 0) j["kernel_time"] = 1e3 * kernels;
    j["ratio"] = r.ratio;
    j["ratio_iqr"] = r.ratio_spread;
    j["cpu_ratio"] = r.cpu_ratio;
    j["compile_s"] = r.cold.build;
    j["first_launch_s"] = r.cold.first_launch;
    j["cached_compile_s"] = r.cached.build;
    j["cached_first_launch_s"] = r.cached.first_launch;
}

void add_counts(Json& j, const SpeedReport& r)
{
    const host::Statistics& s = r.statistics;
    j["kernel_that_ran"] = kernel_name(r.kernel);
    j["variant"] = variant_of(r.options);
    j["objects"] = r.objects;
    j["rays"] = s.rays;
    j["shadow_rays"] = s.shadow;
    j["queries"] = s.queries;
    j["tests"] = s.tests;
    j["mrays_s"] = millions_a_second(r, rays_of(r));
    j["mqueries_s"] = millions_a_second(r, static_cast<double>(s.queries));
    j["mtests_s"] = millions_a_second(r, static_cast<double>(s.tests));
    j["ns_per_ray"] = nanoseconds_per_ray(r);
    j["scene_bytes"] = r.scene_bytes;
    j["picture_bytes"] = host::area(r.contender.view.picture) * 4 * sizeof(float);
    j["peak_bytes"] = r.peak_bytes;
    for (const host::StatisticsField& f : host::statistics_fields())
        if (f.fault) j[f.name] = s.*f.value;
}

void add_errors(Json& j, const SceneSpeed& of, const SpeedReport& r, const SpeedSettings& settings)
{
    if (r.arithmetic) {
        j["error_from"] = error_name(settings.error);
        j["error_pixels"] = of.compared_pixels;
        j["rmse"] = r.arithmetic->rmse;
        j["max_error"] = r.arithmetic->max_error;
        j["p999"] = r.arithmetic->p999;
        j["not_numbers"] = r.arithmetic->not_numbers;
    }
    if (r.settings) {
        j["reference"] = of.reference;
        j["settings_rmse"] = r.settings->rmse;
        j["settings_max_error"] = r.settings->max_error;
        j["settings_p999"] = r.settings->p999;
        j["settings_not_numbers"] = r.settings->not_numbers;
    }
}

Json report_json(const SceneSpeed& of, const SpeedReport& r, const SpeedSettings& settings)
{
    Json j = contender_json(of, r);
    if (!r.failure.empty()) {
        j["error_occurred"] = true;
        j["error_message"] = r.failure;
        return j;
    }
    add_times(j, r);
    add_counts(j, r);
    add_errors(j, of, r, settings);
    j["real_times"] = r.real; // s, each round's
    j["cpu_times"] = r.cpu;
    return j;
}

std::string csv_field(const Json& value)
{
    if (value.is_null()) return "";
    std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + "\"";
}

} // namespace

Load machine_load()
{
    Load out{};
    ::getloadavg(out.data(), static_cast<int>(out.size()));
    return out;
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

Json speed_json(std::span<const SceneSpeed> results, const SpeedSettings& settings, const Load& load)
{
    Json out = {{"context",
                 {{"date", fmt::format("{:%FT%T}Z", fmt::gmtime(std::time(nullptr)))},
                  {"executable", "clucida-bench"},
                  {"library_version", CLUCIDA_VERSION},
                  {"num_cpus", std::thread::hardware_concurrency()},
                  {"load_avg", load},
                  {"rounds", settings.rounds},
                  {"error_from", error_name(settings.error)}}},
                {"benchmarks", Json::array()}};
    for (const SceneSpeed& scene : results)
        for (const SpeedReport& r : scene.reports) out["benchmarks"].push_back(report_json(scene, r, settings));
    return out;
}

std::string benchmarks_csv(const Json& report)
{
    std::vector<std::string> names;
    const Json& benchmarks = report.at("benchmarks");
    for (const Json& b : benchmarks)
        for (const auto& [name, value] : b.items())
            if (!value.is_structured() && std::ranges::find(names, name) == names.end()) names.push_back(name);
    const auto line = [&](const auto& field) {
        std::vector<std::string> fields;
        fields.reserve(names.size());
        for (const std::string& name : names) fields.push_back(field(name));
        return fmt::format("{}\r\n", fmt::join(fields, ","));
    };
    std::string out = line([](const std::string& name) { return csv_field(name); });
    for (const Json& b : benchmarks)
        out += line([&](const std::string& name) { return b.contains(name) ? csv_field(b.at(name)) : std::string(); });
    return out;
}

} // namespace clucida::bench
