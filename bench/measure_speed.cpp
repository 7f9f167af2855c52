#include "bench/measure_speed.h"

#include "bench/median.h"
#include "bench/speed_error.h"
#include "bench/spread.h"
#include "bench/temporary_folder.h"
#include "bench/worker_process.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>

namespace clucida::bench {
namespace {

/// What limits a CPU device's threads, for whichever implementation it is: all read it once, as they start.
constexpr const char* thread_limits[] = {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT", "LP_NUM_THREADS"};
/// Where the implementations and this program keep compiled kernels.
constexpr const char* caches[] = {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "MESA_SHADER_CACHE_DIR", "CUDA_CACHE_PATH"};

/// A contender with the folder that is its own, in which it finds what it has compiled before.
struct Entrant {
    SpeedTask task;
    host::Environment environment;
    std::string name; ///< for errors
};

Entrant make_entrant(const host::SceneOptions& scene, const SpeedSettings& settings, const SpeedContender& contender,
                     const std::filesystem::path& folder)
{
    Entrant out{settings.task, {}, fmt::format("{}, {}", scene.file, describe(contender))};
    out.task.scene = scene;
    out.task.contender = contender;
    out.task.native.folder = folder;
    std::filesystem::create_directories(folder);
    for (const char* cache : caches) out.environment[cache] = folder.string();
    if (contender.threads)
        for (const char* limit : thread_limits) out.environment[limit] = std::to_string(contender.threads);
    return out;
}

std::unique_ptr<WorkerProcess> start(const Entrant& entrant)
{
    return std::make_unique<WorkerProcess>(entrant.name, "speed-worker", entrant.environment);
}

Readying open(WorkerProcess& worker, const Entrant& entrant, SpeedReport& report)
{
    nlohmann::json request = to_json(entrant.task);
    request["do"] = "open";
    const nlohmann::json answer = worker.ask(request);
    report.what = answer.at("what");
    report.options = answer.at("options");
    report.threads = answer.at("threads");
    return {answer.at("build"), answer.at("first_launch")};
}

nlohmann::json take_turn(WorkerProcess& worker, double least_seconds)
{
    return worker.ask({{"do", "turn"}, {"least_seconds", least_seconds}});
}

void note_turn(const nlohmann::json& turn, SpeedReport& report)
{
    report.real.push_back(turn.at("real"));
    report.cpu.push_back(turn.at("cpu"));
    report.pictures += turn.at("pictures").get<std::size_t>();
    for (const host::StatisticsField& f : host::statistics_fields())
        report.statistics.*f.value = turn.at("statistics").at(f.name);
    report.peak_bytes = turn.at("peak_bytes");
}

host::Picture ask_pixels(WorkerProcess& worker, const std::vector<std::size_t>& pixels)
{
    const nlohmann::json answer = worker.ask({{"do", "pixels"}, {"pixels", pixels}});
    host::Picture out = host::make_picture(static_cast<unsigned>(pixels.size()), 1);
    const nlohmann::json& rgb = answer.at("rgb");
    for (std::size_t i = 0; i < out.rgb.size(); ++i) // JSON has no infinities and no NaN
        out.rgb[i] = rgb.at(i).is_number() ? rgb.at(i).get<float>() : std::nanf("");
    return out;
}

/// The pixels as they should be.
host::Picture reference(const host::SceneSource& source, const SpeedSettings& settings, const Entrant& double_kernel,
                        const std::vector<std::size_t>& pixels)
{
    if (settings.error == ErrorFrom::oracle)
        return true_pixels(source, view_of(settings.task), pixels, settings.oracle_threads);
    const auto worker = start(double_kernel);
    SpeedReport unused;
    open(*worker, double_kernel, unused);
    take_turn(*worker, 0);
    return ask_pixels(*worker, pixels);
}

std::vector<double> ratios(const std::vector<double>& of, const std::vector<double>& to)
{
    std::vector<double> out;
    for (std::size_t i = 0; i < of.size(); ++i) out.push_back(of[i] / to[i]);
    return out;
}

} // namespace

std::string describe(const SpeedContender& c)
{
    std::string out = fmt::format("{} {}", is_native(c) ? "native" : c.device,
                                  c.precision == host::Precision::twofold ? "double" : "float");
    if (c.threads) out += fmt::format(", {} thread{}", c.threads, c.threads == 1 ? "" : "s");
    return out;
}

SceneSpeed measure_speed(const host::SceneOptions& scene, const SpeedSettings& settings,
                         const std::function<void(double)>& progress)
{
    const host::SceneSource source = host::load_scene(scene); // what is wrong with it is told before any work
    SceneSpeed out;
    out.name = source.name;
    const std::size_t count = settings.contenders.size();
    double done = 0;
    const auto advance = [&] { progress(++done / static_cast<double>(count * (settings.rounds + 3) + 1)); };

    const TemporaryFolder folder;
    std::vector<Entrant> entrants;
    std::vector<std::unique_ptr<WorkerProcess>> workers;
    for (std::size_t i = 0; i < count; ++i) {
        const SpeedContender& contender = settings.contenders[i];
        entrants.push_back(make_entrant(scene, settings, contender, folder.path() / std::to_string(i)));
        SpeedReport& report = out.reports.emplace_back();
        report.contender = contender;
        report.cold = open(*start(entrants[i]), entrants[i], report);
        advance();
        workers.push_back(start(entrants[i]));
        report.cached = open(*workers[i], entrants[i], report);
        advance();
    }
    for (const auto& worker : workers) {
        take_turn(*worker, settings.least_turn); // warms caches and clocks, and capacities come to suffice
        advance();
    }
    for (unsigned round = 0; round < settings.rounds; ++round)
        for (std::size_t turn = 0; turn < count; ++turn, advance()) {
            const std::size_t i = (round + turn) % count; // nobody always comes first, nor always after the same
            note_turn(take_turn(*workers[i], settings.least_turn), out.reports[i]);
        }
    for (SpeedReport& r : out.reports) {
        const std::vector<double> real = ratios(r.real, out.reports.front().real);
        r.ratio = median(real);
        r.ratio_spread = interquartile_range(real);
        r.cpu_ratio = median(ratios(r.cpu, out.reports.front().cpu));
    }

    if (settings.error == ErrorFrom::none) return out;
    const std::vector<std::size_t> pixels = grid_pixels(settings.task.picture, settings.error_pixels);
    const SpeedContender in_double{settings.reference_device, host::Precision::twofold, 0, {}};
    const host::Picture truth =
        reference(source, settings, make_entrant(scene, settings, in_double, folder.path() / "reference"), pixels);
    for (std::size_t i = 0; i < count; ++i)
        out.reports[i].error = host::compare(ask_pixels(*workers[i], pixels), truth, 0);
    out.compared_pixels = pixels.size();
    return out;
}

} // namespace clucida::bench
