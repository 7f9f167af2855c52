#include "host/renderer.h"

#include "host/errors.h"
#include "host/workarounds.h"

#include <fmt/format.h>

namespace clucida::host {
namespace {

constexpr unsigned most_capacity = 512;
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

} // namespace

KernelShape kernel_shape(const DeviceInfo& device, std::size_t objects)
{
    const bool wide = device.kind == DeviceKind::cpu && device.float_lanes >= packet_lanes;
    return wide && objects <= most_packet_objects && !copies_calls(device) ? KernelShape::packets : KernelShape::pixels;
}

Shape group_of(const Renderer& renderer, const cl::Kernel& kernel, std::optional<Shape> wanted)
{
    const DeviceInfo& device = renderer.device.info;
    const std::size_t most = std::min<std::size_t>(
        kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(renderer.device.handle), device.max_group);
    if (wanted && area(*wanted) > most)
        throw Failure(fmt::format("a work-group of {}x{} is too large for {}: at most {} work-items", wanted->width,
                                  wanted->height, describe(device), most));
    if (wanted) return *wanted;
    return renderer.group && area(*renderer.group) <= most ? *renderer.group : choose_group(most);
}

void enqueue_each(const Renderer& renderer, const cl::Kernel& kernel, std::size_t count)
{
    const std::size_t group = area(group_of(renderer, kernel, {}));
    const std::size_t items = (count + group - 1) / group * group;
    renderer.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(group));
}

Renderer make_renderer(const Device& device, Profiling profiling)
{
    try {
        Renderer renderer;
        renderer.device = device;
        if (device.info.native) return renderer;
        renderer.context = cl::Context(device.handle);
        renderer.profiling = profiling;
        renderer.queue = cl::CommandQueue(renderer.context, device.handle,
                                          profiling == Profiling::yes ? CL_QUEUE_PROFILING_ENABLE : 0);
        return renderer;
    } catch (const cl::Error& e) {
        throw Failure(fmt::format("{}: {}", describe(device.info), explain(e)));
    }
}

std::vector<Renderer> make_renderers(std::span<const Device> devices)
{
    std::vector<Renderer> out;
    for (const Device& d : devices) out.push_back(make_renderer(d));
    return out;
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

} // namespace clucida::host
