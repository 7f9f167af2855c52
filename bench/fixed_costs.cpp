#include "bench/fixed_costs.h"

#include "bench/median.h"
#include "bench/speed_seats.h"
#include "bench/worker_process.h"
#include "host/interrupt.h"
#include "host/stopwatch.h"

#include <nlohmann/json.hpp>

namespace clucida::bench {

FixedCosts measure_builds(const SpeedTask& task, const std::filesystem::path& folder)
{
    nlohmann::json request = to_json(task);
    request["do"] = "open";
    const auto open = [&] { return WorkerProcess(task.scene.file, "speed-worker", caches_in(folder)).ask(request); };
    const nlohmann::json cold = open(), cached = open();
    FixedCosts out;
    out.cold_build = cold.at("build");
    out.cold_launch = cold.at("first_launch");
    out.cached_build = cached.at("build");
    out.cached_launch = cached.at("first_launch");
    return out;
}

void measure_rest(const host::SceneOptions& scene, const scene::View& view, const host::Device& device,
                  const host::RenderSettings& settings, unsigned rounds, FixedCosts& costs)
{
    std::vector<double> read, compile, upload, empty_launch, way_back;
    host::Renderer renderer = host::make_renderer(device, host::Profiling::yes);
    scene::Needs needs;
    for (unsigned round = 0; round <= rounds; ++round) {
        host::Stopwatch watch;
        const host::SceneSource source = host::load_scene(scene);
        read.push_back(watch.lap());
        scene::Compiled compiled = host::compile_scene(source, view);
        compile.push_back(watch.seconds());
        compiled.needs = scene::unite(needs, compiled.needs);
        const host::Frame frame = host::render_frame(renderer, compiled, settings, {{}, host::interrupted, {}});
        needs = frame.needs;
        if (round == 0) continue; // its program is built
        upload.push_back(frame.timings.upload);
        empty_launch.push_back(frame.timings.first_enqueue);
        way_back.push_back(frame.timings.trace - frame.timings.kernels);
        costs.scene_bytes = scene::byte_count(compiled.buffers);
    }
    costs.read = median(read);
    costs.compile = median(compile);
    costs.upload = median(upload);
    costs.empty_launch = median(empty_launch);
    costs.way_back = median(way_back);
    costs.picture_bytes = host::area(settings.picture) * 4 * sizeof(float);
    costs.counter_bytes = std::size_t{STAT_SLOTS} * STAT_COUNT * sizeof(std::uint32_t);
}

} // namespace clucida::bench
