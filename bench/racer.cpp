#include "bench/racer.h"

#include "bench/compiled_views.h"
#include "bench/native_library.h"
#include "host/errors.h"
#include "host/interrupt.h"
#include "host/share_work.h"
#include "host/stopwatch.h"
#include "kernels/packets/tile.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <thread>

namespace clucida::bench {
namespace {

/// Renderers by what their programs are compiled for, so that views in turn do not compile in turn.
struct Fleet {
    host::Device device;
    std::map<std::string, host::Renderer> renderers = {};

    host::Renderer& of(const scene::Needs& needs)
    {
        const auto [at, added] = renderers.try_emplace(scene::build_options(needs));
        if (added) at->second = host::make_renderer(device, host::Profiling::yes);
        return at->second;
    }
};

Racer opencl_racer(const SpeedTask& task, std::shared_ptr<CompiledViews> views)
{
    auto fleet = std::make_shared<Fleet>(Fleet{host::find_device(task.contender.device)});
    const host::DeviceInfo& device = fleet->device.info;
    Racer out;
    out.what = host::describe(device);
    out.threads = device.kind == host::DeviceKind::cpu ? device.compute_units : 0;
    host::RenderSettings settings;
    settings.precision = task.contender.precision;
    settings.kernel = task.contender.kernel;
    settings.group = task.contender.group;
    out.render = [fleet, settings, views](const SpeedView& view, std::optional<host::Shape> part) mutable {
        const scene::Compiled& compiled = views->at(view);
        settings.picture = part.value_or(view.picture);
        settings.samples = view.samples;
        settings.tile = part; // one launch, and no time spent on choosing
        host::Frame frame = host::render_frame(fleet->of(compiled.needs), compiled, settings, {{}, host::interrupted});
        views->keep(frame.needs);
        return frame;
    };
    return out;
}

/// Each thread takes the next rows that nobody has, and counts on its own.
void trace_natively(const NativeLibrary& library, const scene::Compiled& compiled, unsigned samples, unsigned threads,
                    host::Frame& frame)
{
    NativeScene scene{};
    for (std::size_t i = 0; i < BUFFER_COUNT; ++i)
        scene.buffers[i] = compiled.buffers.bytes[i].empty() ? nullptr : compiled.buffers.bytes[i].data();
    const unsigned width = frame.picture.width, height = frame.picture.height;
    const std::size_t row_floats = std::size_t{4} * width;
    std::vector<float> sums(row_floats * height);
    std::vector<host::Statistics> counted(threads);
    const unsigned band = frame.kernel == host::KernelShape::packets ? PACKET_TILE : 1; // rows
    host::share_work((height + band - 1) / band, threads, [&](std::size_t number, unsigned worker) {
        if (host::interrupted()) return;
        std::array<std::uint32_t, STAT_COUNT> counters{};
        const unsigned row = static_cast<unsigned>(number) * band;
        library.render(&scene, 0, row, width, std::min(band, height - row), 0, samples, sums.data() + row_floats * row,
                       counters.data());
        host::add_rows(counted[worker], counters);
    });
    if (host::interrupted()) throw host::Interrupted();
    for (std::size_t i = 0; i < frame.picture.rgb.size(); ++i)
        frame.picture.rgb[i] = sums[i / 3 * 4 + i % 3] / static_cast<float>(samples);
    frame.statistics = {};
    for (const host::Statistics& s : counted) host::add(frame.statistics, s);
}

/// As render_frame() does it.
Racer native_racer(const SpeedTask& task, std::shared_ptr<CompiledViews> views)
{
    const unsigned all = std::max(std::thread::hardware_concurrency(), 1U);
    const unsigned threads = task.contender.threads ? task.contender.threads : all;
    auto libraries = std::make_shared<std::map<std::string, NativeLibrary>>();
    Racer out;
    out.what = describe(task.native);
    out.threads = threads;
    out.render = [views, libraries, threads, task](const SpeedView& view, std::optional<host::Shape> part) {
        host::Frame frame;
        frame.kernel = task.contender.kernel.value_or(host::KernelShape::packets);
        const host::Shape shape = part.value_or(view.picture);
        frame.picture = host::make_picture(shape.width, shape.height);
        scene::Compiled compiled = views->at(view);
        for (;;) {
            NativeLibrary& library = (*libraries)[scene::build_options(compiled.needs)];
            if (!library.render) {
                library = native_library(task.native, compiled.needs, task.contender.precision, frame.kernel);
                frame.timings.build += library.seconds;
            }
            const host::Stopwatch watch;
            const host::CpuStopwatch cpu;
            trace_natively(library, compiled, view.samples, threads, frame);
            frame.timings.trace += watch.seconds();
            frame.timings.trace_cpu += cpu.seconds();
            if (!host::enlarge(compiled.needs, frame.statistics)) break;
            ++frame.retries;
        }
        frame.needs = compiled.needs;
        views->keep(frame.needs);
        return frame;
    };
    return out;
}

} // namespace

Racer make_racer(const SpeedTask& task)
{
    const auto views = std::make_shared<CompiledViews>(task);
    Racer out = is_native(task.contender) ? native_racer(task, views) : opencl_racer(task, views);
    const scene::Buffers& buffers = views->at(task.contender.view).buffers;
    out.objects = scene::object_count(buffers);
    out.scene_bytes = scene::byte_count(buffers);
    return out;
}

} // namespace clucida::bench
