#include "bench/error_output.h"
#include "bench/median.h"
#include "bench/precision_name.h"
#include "bench/profile_output.h"
#include "bench/spread.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ctime>
#include <thread>

namespace clucida::bench {
namespace {

using Json = nlohmann::ordered_json;

Json mix_json(const InstructionMix& mix)
{
    Json kinds = Json::object(), loads = Json::object(), stores = Json::object();
    for (const auto& [kind, times] : mix.kinds) kinds[describe(kind)] = times;
    for (const auto& [bits, times] : mix.loads) loads[std::to_string(bits)] = times;
    for (const auto& [bits, times] : mix.stores) stores[std::to_string(bits)] = times;
    return {{"instructions", mix.instructions}, {"float_flops", mix.single_flops}, {"double_flops", mix.double_flops},
            {"load_bytes", mix.load_bytes},     {"store_bytes", mix.store_bytes},  {"kinds", kinds},
            {"loads_by_bits", loads},           {"stores_by_bits", stores}};
}

/// What every entry begins with; milliseconds.
Json entry(const SceneProfile& p, const std::string& name, double real, double cpu)
{
    return {{"name", fmt::format("profile/{}/{}", p.name, name)},
            {"run_type", "iteration"},
            {"real_time", real},
            {"cpu_time", cpu},
            {"time_unit", "ms"},
            {"scene", p.name}};
}

Json counts_json(const SceneProfile& p, const ProfileSettings& settings)
{
    Json j = entry(p, "counts", 0, 0);
    j["pixels"] = host::area(settings.picture);
    j["objects"] = p.objects;
    for (const host::StatisticsField& f : host::statistics_fields()) j[f.name] = p.counted.*f.value;
    j["nodes"] = p.nodes;
    j["path_pixels"] = p.paths.pixels;
    j["path_rays"] = p.paths.rays;
    j["path_rays_counted"] = p.paths.counted_rays;
    j["path_hits"] = p.paths.hits;
    j["hops"] = Json::array();
    for (const HopCount& h : p.paths.hops)
        j["hops"].push_back({{"rays", h.rays},
                             {"hits", h.hits},
                             {"branched", h.branched},
                             {"ended", h.ended},
                             {"deepest_pixels", h.deepest}});
    return j;
}

Json time_json(const SceneProfile& p, const ProfileTime& row, unsigned rounds)
{
    const AblationTime& t = row.time;
    Json j = entry(p, fmt::format("time/{}/{}", how_name(t.how), t.name), 1e3 * median(t.real), 1e3 * median(t.cpu));
    j["repetitions"] = rounds;
    j["how"] = how_name(t.how);
    j["device_time"] = 1e3 * median(t.device);
    j["real_time_iqr"] = 1e3 * interquartile_range(t.real);
    j["cpu_time_iqr"] = 1e3 * interquartile_range(t.cpu);
    j["ratio"] = t.ratio;
    if (t.how == How::left_out || t.how == How::twice) {
        j["cost_ms"] = 1e3 * t.cost;
        j["cost_iqr_ms"] = 1e3 * t.cost_spread;
        j["share"] = t.share;
        if (t.each != 0) j["ns_each"] = t.each;
    }
    for (const host::StatisticsField& f : host::statistics_fields()) j[f.name] = t.counted.*f.value;
    j["change_rmse"] = t.change.rmse;
    j["change_max"] = t.change.max_error;
    if (row.error) {
        j["rmse"] = row.error->rmse;
        j["max_error"] = row.error->max_error;
    }
    return j;
}

Json fixed_json(const SceneProfile& p)
{
    const FixedCosts& f = p.fixed;
    Json j = entry(p, "fixed", 1e3 * f.way_back, 0);
    j["read_s"] = f.read;
    j["scene_compile_s"] = f.compile;
    j["compile_s"] = f.cold_build;
    j["first_launch_s"] = f.cold_launch;
    j["cached_compile_s"] = f.cached_build;
    j["cached_first_launch_s"] = f.cached_launch;
    j["upload_s"] = f.upload;
    j["scene_bytes"] = f.scene_bytes;
    j["empty_launch_s"] = f.empty_launch;
    j["way_back_s"] = f.way_back;
    j["picture_bytes"] = f.picture_bytes;
    return j;
}

Json code_json(const SceneProfile& p, const StaticCode& code)
{
    Json j = entry(p, "code", 0, 0);
    j["of"] = code.what;
    j["mix"] = mix_json(code.all);
    j["functions"] = Json::array();
    for (const FunctionMix& f : code.functions) {
        Json function = {{"name", f.name}};
        function.update(mix_json(f.mix));
        j["functions"].push_back(std::move(function));
    }
    return j;
}

Json events_json(const CallgrindEvents& e)
{
    return {{"instructions", e.instructions},
            {"data_reads", e.data_reads},
            {"data_writes", e.data_writes},
            {"l1_data_misses", e.l1_data_misses},
            {"l1_instruction_misses", e.l1_instruction_misses},
            {"last_misses", e.last_data_misses + e.last_instruction_misses},
            {"branches", e.conditional_branches + e.indirect_branches},
            {"mispredicted", e.conditional_mispredicted + e.indirect_mispredicted}};
}

Json executed_json(const SceneProfile& p, const ExecutedPicture& e)
{
    Json j = entry(p, "executed", 1e3 * e.cpu, 1e3 * e.cpu);
    j["of"] = e.what;
    j["pixels"] = host::area(e.picture);
    j["rays"] = e.counted.rays;
    j["shadow"] = e.counted.shadow;
    j["events"] = events_json(e.code.total);
    j["mix"] = mix_json(e.mix);
    j["functions"] = Json::object();
    for (const auto& [name, events] : e.code.functions) j["functions"][name] = events_json(events);
    j["peak_flops"] = p.peaks.flops;
    j["clock_hz"] = p.peaks.clock;
    return j;
}

} // namespace

Json profile_json(std::span<const SceneProfile> profiles, const ProfileSettings& settings,
                  const host::DeviceInfo& device)
{
    Json out = {{"context",
                 {{"date", fmt::format("{:%FT%T}Z", fmt::gmtime(std::time(nullptr)))},
                  {"executable", "clucida-bench"},
                  {"library_version", CLUCIDA_VERSION},
                  {"num_cpus", std::thread::hardware_concurrency()},
                  {"device", host::describe(device)},
                  {"counts_by", counts_by_processor(device) ? "cpu_time" : "real_time"},
                  {"width", settings.picture.width},
                  {"height", settings.picture.height},
                  {"precision", precision_name(settings.precision)},
                  {"rounds", settings.rounds}}},
                {"benchmarks", Json::array()}};
    Json& entries = out["benchmarks"];
    for (const SceneProfile& p : profiles) {
        if (settings.parts.counts) entries.push_back(counts_json(p, settings));
        for (const ProfileTime& row : p.times)
            if (!row.time.meaningless) entries.push_back(time_json(p, row, settings.rounds));
        if (settings.parts.fixed) entries.push_back(fixed_json(p));
        for (const StaticCode& code : p.code) entries.push_back(code_json(p, code));
        if (p.executed) entries.push_back(executed_json(p, *p.executed));
    }
    return out;
}

} // namespace clucida::bench
