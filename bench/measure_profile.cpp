#include "bench/measure_profile.h"

#include "bench/device_peak.h"
#include "bench/half_storage.h"
#include "bench/speed_error.h"
#include "bench/temporary_folder.h"
#include "host/errors.h"
#include "host/interrupt.h"

#include <fmt/format.h>

namespace clucida::bench {
namespace {

struct Subject {
    const host::SceneOptions& options;
    const host::Device& device;
    const ProfileSettings& settings;
    host::SceneSource source;
    scene::View view;
    host::RenderSettings render;
    scene::Compiled compiled; ///< with capacities that suffice
};

Subject make_subject(const host::SceneOptions& scene, const host::Device& device, const ProfileSettings& settings)
{
    Subject out{scene, device, settings, host::load_scene(scene), {}, {}, {}};
    out.view = {settings.picture.width, settings.picture.height, 1, {}, {}, {}, {}};
    out.render.picture = settings.picture;
    out.render.tile = settings.picture; // one launch, and no time spent on choosing
    out.render.precision = settings.precision;
    out.render.kernel = settings.kernel;
    out.compiled = host::compile_scene(out.source, out.view);
    return out;
}

/// Renders the picture once: counts, capacities, and which kernel it is.
void begin(Subject& s, SceneProfile& out)
{
    host::Renderer renderer = host::make_renderer(s.device);
    const host::Frame frame = host::render_frame(renderer, s.compiled, s.render, {{}, host::interrupted, {}});
    s.compiled.needs = frame.needs;
    s.render.kernel = frame.kernel;
    out.kernel = frame.kernel;
    out.counted = frame.statistics;
    out.objects = scene::object_count(s.compiled.buffers);
    out.coordinate_bytes = coordinate_bytes(s.compiled.buffers);
    out.node_bytes = s.compiled.buffers.bytes[BUFFER_NODES].size();
}

void count(const Subject& s, SceneProfile& out)
{
    host::Renderer renderer = host::make_renderer(s.device);
    host::RenderSettings counting = s.render;
    counting.kernels = stage_kernels("counted");
    const host::Frame frame = host::render_frame(renderer, s.compiled, counting, {{}, host::interrupted, {}});
    out.nodes = frame.statistics.silent - out.counted.silent; // they are counted together
    out.paths = measure_path_lengths(s.device, s.compiled, s.render, s.settings.path_pixels);
}

host::Picture picked(const host::Picture& picture, const std::vector<std::size_t>& pixels)
{
    host::Picture out = host::make_picture(static_cast<unsigned>(pixels.size()), 1);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) out.rgb[3 * i + k] = picture.rgb[3 * pixels[i] + k];
    return out;
}

void time(const Subject& s, SceneProfile& out, const std::function<void(double)>& progress)
{
    scene::View short_view = s.view;
    short_view.max_hops = 1;
    const scene::Compiled one_hop = host::compile_scene(s.source, short_view);
    const AblationScene scene{s.compiled, one_hop, s.device.info, out.kernel, out.counted};
    const std::vector<std::size_t> pixels = grid_pixels(s.settings.picture, s.settings.error_pixels);
    const host::Picture truth = true_pixels(s.source, s.view, pixels, s.settings.oracle_threads);
    for (AblationTime& time : time_ablations(s.device, make_ablations(scene, s.render), s.settings.rounds, progress)) {
        ProfileTime& row = out.times.emplace_back();
        if (time.how != How::left_out) row.error = host::compare(picked(time.picture, pixels), truth, 0);
        time.picture = {};
        row.time = std::move(time);
    }
}

SpeedTask task_of(const Subject& s)
{
    SpeedTask out;
    out.scene = s.options;
    out.contender = {host::place(s.device.info), s.settings.precision, 0, s.render.kernel};
    out.contender.view.picture = s.settings.picture;
    out.native.compiler = s.settings.compiler;
    return out;
}

/// What cannot be had here is told, and the rest measured all the same.
template <typename Work>
void attempt(SceneProfile& out, const Work& work)
{
    try {
        work();
    } catch (const host::Failure& e) {
        out.notes.emplace_back(e.what());
    }
}

void look_at_code(const Subject& s, const std::filesystem::path& folder, SceneProfile& out)
{
    attempt(out, [&] {
        StaticCode code = static_code(host::describe(s.device.info), folder / "device");
        if (code.functions.empty())
            out.notes.push_back(host::describe(s.device.info) + " leaves no machine code of x86-64 in its cache");
        else
            out.code.push_back(std::move(code));
    });
    attempt(out, [&] {
        NativeBuild build{s.settings.compiler, "native", folder / "native"};
        std::filesystem::create_directories(build.folder);
        native_library(build, s.compiled.needs, s.settings.precision, out.kernel);
        out.code.push_back(static_code("native: " + describe(build), build.folder));
    });
}

void execute(const Subject& s, const std::filesystem::path& folder, SceneProfile& out)
{
    attempt(out, [&] {
        SpeedTask task = task_of(s);
        task.contender.view.picture = s.settings.executed_picture;
        std::filesystem::create_directories(folder / "executed");
        out.executed = count_executed(task, folder / "executed");
        out.peaks = {measure_peak(s.device, s.settings.precision), measure_clock()};
    });
}

} // namespace

SceneProfile measure_profile(const host::SceneOptions& scene, const host::Device& device,
                             const ProfileSettings& settings, const std::function<void(double)>& progress)
{
    Subject s = make_subject(scene, device, settings);
    SceneProfile out;
    out.name = s.source.name;
    begin(s, out);
    progress(0.05);
    if (settings.parts.counts) count(s, out);
    progress(0.1);
    if (settings.parts.times) time(s, out, [&](double done) { progress(0.1 + 0.5 * done); });
    progress(0.6);
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "device");
    if (settings.parts.fixed || settings.parts.code) out.fixed = measure_builds(task_of(s), folder.path() / "device");
    if (settings.parts.fixed) measure_rest(scene, s.view, device, s.render, settings.rounds, out.fixed);
    progress(0.8);
    if (settings.parts.code) look_at_code(s, folder.path(), out);
    progress(0.9);
    if (settings.parts.executed) execute(s, folder.path(), out);
    progress(1);
    return out;
}

} // namespace clucida::bench
