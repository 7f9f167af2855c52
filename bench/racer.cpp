#include "bench/racer.h"

#include "bench/native_library.h"
#include "host/errors.h"
#include "host/interrupt.h"
#include "host/share_work.h"
#include "host/stopwatch.h"

#include <algorithm>
#include <array>
#include <memory>
#include <thread>

namespace clucida::bench {
namespace {

Racer opencl_racer(const SpeedTask& task, scene::Compiled compiled)
{
    auto renderer = std::make_shared<host::Renderer>(host::make_renderer(host::find_device(task.contender.device)));
    const host::DeviceInfo& device = renderer->device.info;
    Racer out;
    out.what = host::describe(device);
    out.options = scene::build_options(compiled.needs);
    out.threads = device.kind == host::DeviceKind::cpu ? device.compute_units : 0;
    host::RenderSettings settings;
    settings.samples = task.samples;
    settings.precision = task.contender.precision;
    settings.kernel = task.contender.kernel;
    out.render = [renderer, settings, compiled = std::move(compiled)](host::Shape part) mutable {
        settings.picture = part;
        settings.tile = part; // one launch, and no time spent on choosing
        host::Frame frame = host::render_frame(*renderer, compiled, settings, {{}, host::interrupted});
        compiled.needs = frame.needs;
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
    const unsigned band = frame.kernel == host::KernelShape::packets ? 32 : 1; // rows, as high as a block of packets
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
    for (const host::Statistics& s : counted)
        for (const host::StatisticsField& f : host::statistics_fields()) frame.statistics.*f.value += s.*f.value;
}

/// As render_frame() does it.
Racer native_racer(const SpeedTask& task, scene::Compiled compiled)
{
    struct State {
        scene::Compiled compiled;
        NativeLibrary library;
    };
    auto state = std::make_shared<State>(State{std::move(compiled), {}});
    const unsigned all = std::max(std::thread::hardware_concurrency(), 1U);
    const unsigned threads = task.contender.threads ? task.contender.threads : all;
    Racer out;
    out.what = describe(task.native);
    out.options = scene::build_options(state->compiled.needs);
    out.threads = threads;
    out.render = [state, threads, task](host::Shape part) {
        host::Frame frame;
        frame.kernel = task.contender.kernel.value_or(host::KernelShape::packets);
        frame.picture = host::make_picture(part.width, part.height);
        for (;;) {
            if (!state->library.render) {
                state->library =
                    native_library(task.native, state->compiled.needs, task.contender.precision, frame.kernel);
                frame.timings.build += state->library.seconds;
            }
            const host::Stopwatch watch;
            const host::CpuStopwatch cpu;
            trace_natively(state->library, state->compiled, task.samples, threads, frame);
            frame.timings.trace += watch.seconds();
            frame.timings.trace_cpu += cpu.seconds();
            if (!host::enlarge(state->compiled.needs, frame.statistics)) break;
            ++frame.retries;
            state->library = {};
        }
        frame.needs = state->compiled.needs;
        return frame;
    };
    return out;
}

} // namespace

Racer make_racer(const SpeedTask& task)
{
    const host::SceneSource source = host::load_scene(task.scene);
    scene::Compiled compiled = host::compile_scene(source, view_of(task));
    compiled.needs.interior = std::max(compiled.needs.interior, task.least_interior);
    compiled.needs.stack = std::max(compiled.needs.stack, task.least_stack);
    return is_native(task.contender) ? native_racer(task, std::move(compiled))
                                     : opencl_racer(task, std::move(compiled));
}

} // namespace clucida::bench
