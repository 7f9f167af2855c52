#include "host/renderer.h"

#include "host/errors.h"
#include "host/launches.h"
#include "host/stopwatch.h"

#include <fmt/format.h>

namespace clucida::host {
namespace {

constexpr unsigned most_capacity = 512;
constexpr Shape packet_block{32, 32}; ///< PACKET_TILE (kernels/packets/stacks.h)
constexpr unsigned packet_lanes = 8;
constexpr std::size_t most_packet_objects = 16384; ///< measured: docs/performance.md, "Many objects"
constexpr std::size_t dummy_bytes = 16;            ///< of an empty buffer, which OpenCL does not have

void require_room(const scene::Buffers& buffers, const DeviceInfo& device)
{
    std::size_t total = 0;
    for (const auto& bytes : buffers.bytes) {
        total += bytes.size();
        if (device.max_allocation_bytes && bytes.size() > device.max_allocation_bytes)
            throw Failure(fmt::format("the scene needs a buffer of {} bytes; {} allows {} at most", bytes.size(),
                                      describe(device), device.max_allocation_bytes));
    }
    if (device.global_bytes && total > device.global_bytes)
        throw Failure(fmt::format("the scene needs {} bytes; {} has {}", total, describe(device), device.global_bytes));
}

/// The program of these needs: the one at hand, or a new one.
void prepare_program(Renderer& renderer, const scene::Needs& needs, const RenderSettings& settings, Frame& frame)
{
    const bool at_hand = renderer.program.handle() && renderer.needs == needs &&
                         renderer.precision == settings.precision && renderer.kernel == frame.kernel;
    if (at_hand) return;
    const std::string options = variant_options(needs, settings.precision, renderer.device.info);
    const char* entry = frame.kernel == KernelShape::packets ? "kernels/render_packets.cl" : "kernels/render.cl";
    renderer.program = build_program(renderer.context, renderer.device, resolve_includes(entry, settings.kernels),
                                     options, settings.cache);
    renderer.needs = needs;
    renderer.precision = settings.precision;
    renderer.kernel = frame.kernel;
    ++renderer.builds;
    frame.timings.build += renderer.program.build_seconds;
    frame.note = renderer.program.note;
}

Shape group_of(const cl::Kernel& kernel, const Device& device, std::optional<Shape> wanted = {})
{
    const std::size_t most =
        std::min<std::size_t>(kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device.handle), device.info.max_group);
    if (!wanted) return choose_group(most);
    if (area(*wanted) > most)
        throw Failure(fmt::format("a work-group of {}x{} is too large for {}: at most {} work-items", wanted->width,
                                  wanted->height, describe(device.info), most));
    return *wanted;
}

Shape tile_of(Tracer& tracer, const RenderSettings& settings)
{
    const Shape group = tracer.group();
    if (settings.tile) return round_up(*settings.tile, group);
    const double sample = measure_sample(tracer, settings.picture);
    const double pixel = sample * std::min(settings.samples, samples_per_launch);
    return choose_tile(settings.picture, group, pixel, {.seconds = settings.launch_seconds});
}

void render_once(Renderer& renderer, const DeviceBuffers& buffers, const RenderSettings& settings,
                 const RenderHooks& hooks, Frame& frame)
{
    prepare_program(renderer, frame.needs, settings, frame);
    cl::Kernel kernel(renderer.program.handle, "render");
    for (cl_uint i = 0; i < BUFFER_COUNT; ++i) kernel.setArg(i, buffers[i]);
    Tracer tracer{renderer.context, renderer.queue, kernel, {1, 1}, packet_block, renderer.profiling};
    if (frame.kernel == KernelShape::pixels) {
        tracer.items = group_of(kernel, renderer.device, settings.group);
        tracer.block = {1, 1};
    }

    const Stopwatch first;
    warm_up(tracer);
    frame.timings.first_enqueue += first.seconds();
    if (hooks.cancelled && hooks.cancelled()) throw Interrupted();

    const Stopwatch trace;
    const CpuStopwatch trace_cpu;
    frame.tile = tile_of(tracer, settings);
    const std::size_t tile_bytes = area(frame.tile) * 4 * sizeof(float);
    const std::uint64_t allowed = renderer.device.info.max_allocation_bytes;
    if (allowed && tile_bytes > allowed)
        throw Failure(fmt::format("a tile of {}x{} needs {} bytes; {} allows {} at most: use a smaller --tile",
                                  frame.tile.width, frame.tile.height, tile_bytes, describe(renderer.device.info),
                                  allowed));
    frame.statistics = {};
    frame.timings.rows = 0;
    frame.timings.kernels = 0;
    trace_tiles(tracer, {settings.picture, frame.tile}, settings, hooks, frame);
    frame.timings.trace += trace.seconds() - frame.timings.rows;
    frame.timings.trace_cpu += trace_cpu.seconds();
}

} // namespace

KernelShape kernel_shape(const DeviceInfo& device, std::size_t objects)
{
    const bool wide = device.kind == DeviceKind::cpu && device.float_lanes >= packet_lanes;
    return wide && objects <= most_packet_objects ? KernelShape::packets : KernelShape::pixels;
}

void enqueue_each(const Renderer& renderer, const cl::Kernel& kernel, std::size_t count)
{
    const std::size_t group = area(group_of(kernel, renderer.device));
    const std::size_t items = (count + group - 1) / group * group;
    renderer.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(group));
}

Renderer make_renderer(const Device& device, Profiling profiling)
{
    try {
        Renderer renderer;
        renderer.device = device;
        renderer.context = cl::Context(device.handle);
        renderer.profiling = profiling;
        renderer.queue = cl::CommandQueue(renderer.context, device.handle,
                                          profiling == Profiling::yes ? CL_QUEUE_PROFILING_ENABLE : 0);
        return renderer;
    } catch (const cl::Error& e) {
        throw Failure(fmt::format("{}: {}", describe(device.info), explain(e)));
    }
}

DeviceBuffers upload(const Renderer& renderer, const scene::Buffers& buffers)
{
    require_room(buffers, renderer.device.info);
    DeviceBuffers out;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto& bytes = buffers.bytes[i];
        out[i] = cl::Buffer(renderer.context, CL_MEM_READ_ONLY, std::max(bytes.size(), dummy_bytes));
        if (!bytes.empty()) renderer.queue.enqueueWriteBuffer(out[i], CL_FALSE, 0, bytes.size(), bytes.data());
    }
    renderer.queue.finish();
    return out;
}

bool enlarge(scene::Needs& needs, const Statistics& statistics)
{
    const auto twice = [](unsigned& capacity) {
        if (capacity >= most_capacity) return false;
        capacity = std::min(std::max(capacity, 1u) * 2, most_capacity);
        return true;
    };
    const bool interior = statistics.interior_overflow && twice(needs.interior);
    const bool stack = statistics.stack_overflow && twice(needs.stack);
    return interior || stack;
}

Frame render_frame(Renderer& renderer, const scene::Compiled& compiled, const RenderSettings& settings,
                   const RenderHooks& hooks)
{
    try {
        Frame frame;
        frame.device = describe(renderer.device.info);
        frame.needs = compiled.needs;
        frame.kernel = settings.kernel.value_or(
            kernel_shape(renderer.device.info, compiled.buffers.bytes[BUFFER_OBJECTS].size() / sizeof(LayoutObject)));
        frame.picture = {settings.picture.width, settings.picture.height, {}};
        if (!hooks.rows) frame.picture = make_picture(settings.picture.width, settings.picture.height);

        const Stopwatch watch;
        const DeviceBuffers buffers = upload(renderer, compiled.buffers);
        frame.timings.upload = watch.seconds();

        render_once(renderer, buffers, settings, hooks, frame);
        while (enlarge(frame.needs, frame.statistics)) {
            ++frame.retries;
            render_once(renderer, buffers, settings, hooks, frame);
        }
        return frame;
    } catch (const cl::Error& e) {
        throw Failure(fmt::format("{}: {}", describe(renderer.device.info), explain(e)));
    }
}

Frame render_next(Renderer& renderer, scene::Compiled compiled, RenderSettings& settings, scene::Needs& needs,
                  const RenderHooks& hooks)
{
    compiled.needs = unite(needs, compiled.needs);
    Frame frame = render_frame(renderer, compiled, settings, hooks);
    needs = unite(compiled.needs, frame.needs);
    settings.tile = frame.tile;
    return frame;
}

} // namespace clucida::host
