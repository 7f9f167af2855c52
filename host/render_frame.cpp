#include "host/errors.h"
#include "host/launch_shape.h"
#include "host/native_device.h"
#include "host/opencl_tracer.h"
#include "host/stopwatch.h"
#include "host/trace.h"
#include "host/workarounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <thread>
#include <utility>

namespace clucida::host {
namespace {

/// A renderer at work on a frame.
struct Member {
    Renderer* renderer = nullptr;
    std::optional<DeviceBuffers> buffers;
    std::unique_ptr<Tracer> tracer;
    std::vector<float> seen; ///< a few pixels
    Timings timings;
    std::string note;
    std::exception_ptr failure;
};

/// The program of these needs: the one at hand, or a new one.
void prepare_program(Member& m, const scene::Needs& needs, const RenderSettings& settings, KernelShape kernel)
{
    Renderer& r = *m.renderer;
    const bool at_hand =
        r.program.handle() && r.needs == needs && r.precision == settings.precision && r.kernel == kernel;
    if (at_hand) return;
    const std::string options = variant_options(needs, settings.precision, r.device.info);
    const char* entry = kernel == KernelShape::packets ? "kernels/render_packets.cl" : "kernels/render.cl";
    r.program = build_program(r.context, r.device, resolve_includes(entry, settings.kernels), options, settings.cache);
    r.needs = needs;
    r.precision = settings.precision;
    r.kernel = kernel;
    r.sample_seconds.reset();
    ++r.builds;
    m.timings.build += r.program.build_seconds;
    m.note = r.program.note;
}

/// Measures the shape of the kernel's work-groups where it is not known, and worth it.
void choose_group_shape(Member& m, const RenderSettings& settings)
{
    constexpr double worth_it = 1, look = 0.02; // s of a frame; of a launch that is timed
    Renderer& r = *m.renderer;
    if (r.group || settings.group || settings.cache == KernelCache::off || r.kernel != KernelShape::pixels) return;
    r.group = kept_group(r.device.info);
    const double frame = *r.sample_seconds * static_cast<double>(area(settings.picture)) * settings.samples;
    // One whose first launch takes long compiles with it, for each shape anew.
    if (r.group || frame < worth_it || m.timings.first_enqueue > worth_it) return;
    const Stopwatch watch;
    const Shape usual = m.tracer->grain();
    const auto pixels = static_cast<std::size_t>(look / *r.sample_seconds);
    const auto seconds = [&](Shape group) -> std::optional<double> {
        try {
            RenderSettings own = settings;
            own.group = group;
            return time_middle(*make_opencl_tracer(r, *m.buffers, own), settings.picture, pixels);
        } catch (const Failure&) {
            return std::nullopt; // more than the kernel can
        } catch (const cl::Error&) {
            return std::nullopt;
        }
    };
    r.group = fastest_group(usual, candidate_groups(r.device.info.max_group), seconds);
    keep_group(r.device.info, *r.group);
    m.note = fmt::format("work-groups of {}x{} are the fastest here, measured in {:.2f} s, and kept for next time",
                         r.group->width, r.group->height, watch.seconds());
    m.timings.first_enqueue += watch.seconds();
}

/// Has program, scene and all that comes with the first launch; and knows its speed, where that matters.
void make_ready(Member& m, const scene::Compiled& compiled, const scene::Needs& needs, const RenderSettings& settings,
                bool of_several)
{
    Renderer& r = *m.renderer;
    const KernelShape kernel =
        settings.kernel.value_or(kernel_shape(r.device.info, scene::object_count(compiled.buffers)));
    if (r.device.info.native) {
        r.kernel = kernel;
        m.tracer = make_native_tracer(compiled, needs, settings.precision, kernel);
    } else {
        if (!m.buffers) {
            const Stopwatch watch;
            m.buffers = upload(r, compiled.buffers);
            m.timings.upload += watch.seconds();
        }
        prepare_program(m, needs, settings, kernel);
        m.tracer = make_opencl_tracer(r, *m.buffers, settings);
    }
    const Stopwatch first;
    warm_up(*m.tracer);
    m.timings.first_enqueue += first.seconds();

    const bool known = r.sample_seconds && !settings.measure;
    if (known || (settings.tile && !of_several)) return;
    Probe seen = probe(*m.tracer, settings.picture, of_several ? 2 : 1);
    r.sample_seconds = seen.sample_seconds;
    m.seen = std::move(seen.rgb);
    if (r.device.info.native) return;
    const std::optional<Shape> before = r.group;
    choose_group_shape(m, settings);
    if (r.group != before) m.tracer = make_opencl_tracer(r, *m.buffers, settings);
}

/// Does it, and keeps what goes wrong.
void try_to_make_ready(Member& m, const scene::Compiled& compiled, const scene::Needs& needs,
                       const RenderSettings& settings, bool of_several)
{
    try {
        make_ready(m, compiled, needs, settings, of_several);
    } catch (const cl::Error& e) {
        m.failure =
            std::make_exception_ptr(Failure(fmt::format("{}: {}", describe(m.renderer->device.info), explain(e))));
    } catch (...) {
        m.failure = std::current_exception();
    }
}

std::string what(const std::exception_ptr& failure)
{
    try {
        std::rethrow_exception(failure);
    } catch (const std::exception& e) {
        return e.what();
    }
}

/// Those that failed leave, unless they are all.
void dismiss_failures(std::vector<Member>& team, Frame& frame)
{
    if (std::ranges::all_of(team, [](const Member& m) { return m.failure != nullptr; }))
        std::rethrow_exception(team.front().failure);
    for (Member& m : team) {
        if (!m.failure) continue;
        m.renderer->failure = what(m.failure);
        frame.notes.push_back(fmt::format("a device is not used: {}", m.renderer->failure));
    }
    std::erase_if(team, [](const Member& m) { return m.failure != nullptr; });
}

/// Whether all see the same in a few tiles.
void compare_views(std::span<const Member> team, Frame& frame)
{
    const Member& first = team.front();
    for (const Member& m : team.subspan(1)) {
        if (m.seen.empty() || m.seen.size() != first.seen.size()) continue;
        std::size_t different = 0;
        double most = 0;
        for (std::size_t i = 0; i < m.seen.size(); ++i) {
            different += m.seen[i] != first.seen[i];
            most = std::max(most, std::fabs(double{m.seen[i]} - first.seen[i]));
        }
        if (different)
            frame.notes.push_back(fmt::format("the arithmetic of {} and {} differs: {} of {} values looked at, by "
                                              "{:.1e} at most. The picture depends "
                                              "on which traces what",
                                              describe(first.renderer->device.info), describe(m.renderer->device.info),
                                              different, m.seen.size(), most));
    }
}

std::vector<Member> make_team(std::span<Renderer> renderers)
{
    std::vector<Member> team;
    for (Renderer& r : renderers)
        if (r.failure.empty()) team.emplace_back().renderer = &r;
    if (team.empty()) throw Failure(renderers.front().failure);
    return team;
}

/// They do not wait for each other; what counts is the slowest.
void make_all_ready(std::vector<Member>& team, const scene::Compiled& compiled, const RenderSettings& settings,
                    Frame& frame)
{
    const bool several = team.size() > 1;
    if (several) {
        std::vector<std::jthread> threads;
        threads.reserve(team.size());
        for (Member& m : team)
            threads.emplace_back([&] { try_to_make_ready(m, compiled, frame.needs, settings, several); });
    } else {
        try_to_make_ready(team.front(), compiled, frame.needs, settings, several);
    }
    dismiss_failures(team, frame);
    frame.kernel = team.front().renderer->kernel;
    frame.group = team.front().tracer->group();
    frame.device.clear();
    for (Member& m : team) {
        frame.device += (frame.device.empty() ? "" : " + ") + describe(m.renderer->device.info);
        if (!m.note.empty()) frame.notes.push_back(std::exchange(m.note, {}));
        frame.timings.build = std::max(frame.timings.build, m.timings.build);
        frame.timings.first_enqueue = std::max(frame.timings.first_enqueue, m.timings.first_enqueue);
        frame.timings.upload = std::max(frame.timings.upload, m.timings.upload);
    }
}

/// What stuck work-items mean, of devices that know.
void note_stuck(std::span<const Member> team, Frame& frame)
{
    for (const Member& m : team) {
        const DeviceInfo& device = m.renderer->device.info;
        if (const std::string why = explain_stuck(device); !why.empty())
            frame.notes.push_back(fmt::format("{}: {}", describe(device), why));
    }
}

void render_once(std::vector<Member>& team, const scene::Compiled& compiled, const RenderSettings& settings,
                 const RenderHooks& hooks, Frame& frame)
{
    make_all_ready(team, compiled, settings, frame);
    if (frame.retries == 0) compare_views(team, frame);
    if (hooks.cancelled && hooks.cancelled()) throw Interrupted();

    std::vector<Worker> workers;
    workers.reserve(team.size());
    for (const Member& m : team) workers.push_back({m.tracer.get(), m.renderer->sample_seconds.value_or(0)});
    frame.statistics = {};
    frame.timings.kernels = 0;
    const Stopwatch watch;
    const CpuStopwatch cpu;
    trace_frame(workers, settings, hooks, frame);
    frame.timings.trace += watch.seconds() - frame.timings.rows;
    frame.timings.trace_cpu += cpu.seconds();
    for (std::size_t i = 0; i < team.size(); ++i) {
        if (workers[i].failure.empty()) continue;
        std::string& failure = team[i].renderer->failure;
        failure = fmt::format("{}: {}", describe(team[i].renderer->device.info), workers[i].failure);
        frame.notes.push_back(fmt::format("a device failed, and the others took over: {}", failure));
        team[i].failure = std::make_exception_ptr(Failure(failure));
    }
    std::erase_if(team, [](const Member& m) { return m.failure != nullptr; });
}

} // namespace

Frame render_frame(std::span<Renderer> renderers, const scene::Compiled& compiled, const RenderSettings& settings,
                   const RenderHooks& hooks)
{
    std::vector<Member> team = make_team(renderers);
    try {
        Frame frame;
        frame.needs = compiled.needs;
        frame.picture = {settings.picture.width, settings.picture.height, {}};
        if (!hooks.rows) frame.picture = make_picture(settings.picture.width, settings.picture.height);
        render_once(team, compiled, settings, hooks, frame);
        while (enlarge(frame.needs, frame.statistics)) {
            ++frame.retries;
            render_once(team, compiled, settings, hooks, frame);
        }
        if (frame.statistics.stuck) note_stuck(team, frame);
        return frame;
    } catch (const cl::Error& e) {
        throw Failure(fmt::format("{}: {}", describe(team.front().renderer->device.info), explain(e)));
    }
}

Frame render_next(std::span<Renderer> team, scene::Compiled compiled, RenderSettings& settings, scene::Needs& needs,
                  const RenderHooks& hooks)
{
    compiled.needs = unite(needs, compiled.needs);
    Frame frame = render_frame(team, compiled, settings, hooks);
    needs = unite(compiled.needs, frame.needs);
    settings.measure = false;
    return frame;
}

} // namespace clucida::host
