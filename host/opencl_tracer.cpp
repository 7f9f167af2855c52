#include "host/opencl_tracer.h"

#include "host/workarounds.h"
#include "kernels/packets/tile.h"

#include <algorithm>
#include <limits>

namespace clucida::host {
namespace {

constexpr std::size_t stats_count = std::size_t{STAT_SLOTS} * STAT_COUNT;
constexpr std::size_t stats_words = stats_count + 1; ///< and STAT_NEXT
static_assert(static_cast<int>(stats_count) == STAT_NEXT);
constexpr std::size_t pixel_bytes = 4 * sizeof(float);
constexpr Shape packet_block{PACKET_TILE, PACKET_TILE};

/// A kernel with the scene's buffers set.
struct Entry {
    const Renderer& renderer;
    cl::Kernel kernel;
    Shape items; ///< of a work-group
    Shape grain; ///< pixels of a work-group, or of a packets' block
};

double seconds_of(const cl::Event& event)
{
    constexpr double nanosecond = 1e-9;
    const auto begin = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
    return nanosecond * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() - begin);
}

class OpenclLane : public Lane {
public:
    OpenclLane(Entry& entry, std::size_t pixels)
        : entry_(entry), tile_(entry.renderer.context, CL_MEM_READ_WRITE, pixels * pixel_bytes),
          stats_(entry.renderer.context, CL_MEM_READ_WRITE, stats_words * sizeof(cl_uint)), no_stats_(stats_words)
    {
        sums.resize(pixels * 4);
        counters.resize(stats_count);
    }
    /// The device writes into the lane's memory.
    ~OpenclLane() override
    {
        if (busy_) ::clFinish(entry_.renderer.queue());
    }
    OpenclLane(const OpenclLane&) = delete;
    OpenclLane& operator=(const OpenclLane&) = delete;

    void launch(const Region& region, unsigned begin, unsigned end, bool last) override
    {
        const cl::CommandQueue& queue = entry_.renderer.queue;
        busy_ = true;
        // Not filled: Oclgrind 21.10 takes no note of fills and would call every counter uninitialized.
        queue.enqueueWriteBuffer(stats_, CL_FALSE, 0, stats_words * sizeof(cl_uint), no_stats_.data());
        cl_uint argument = BUFFER_COUNT;
        entry_.kernel.setArg(argument++, cl_uint{region.x});
        entry_.kernel.setArg(argument++, cl_uint{region.y});
        entry_.kernel.setArg(argument++, cl_uint{begin});
        entry_.kernel.setArg(argument++, cl_uint{end});
        entry_.kernel.setArg(argument++, tile_);
        entry_.kernel.setArg(argument++, stats_);
        cl::NDRange range(region.shape.width, region.shape.height), group(entry_.items.width, entry_.items.height);
        if (entry_.renderer.kernel == KernelShape::packets) {
            const cl_uint across = region.shape.width / packet_block.width;
            const cl_uint down = region.shape.height / packet_block.height;
            entry_.kernel.setArg(argument++, across);
            entry_.kernel.setArg(argument, down);
            range = cl::NDRange(std::clamp(entry_.renderer.device.info.compute_units, 1u, across * down));
            group = cl::NDRange(1);
        }
        queue.enqueueNDRangeKernel(entry_.kernel, cl::NullRange, range, group, nullptr, &traced_);
        if (last) queue.enqueueReadBuffer(tile_, CL_FALSE, 0, area(region.shape) * pixel_bytes, sums.data());
        queue.enqueueReadBuffer(stats_, CL_FALSE, 0, stats_count * sizeof(cl_uint), counters.data(), nullptr, &done_);
        queue.flush();
    }
    void wait() override
    {
        done_.wait();
        busy_ = false;
        if (entry_.renderer.profiling == Profiling::yes) kernel_seconds = seconds_of(traced_);
    }

private:
    Entry& entry_;
    cl::Buffer tile_, stats_;
    std::vector<std::uint32_t> no_stats_; ///< what a launch's counters begin as
    cl::Event traced_, done_;             ///< the kernel; the results' way back
    bool busy_ = false;
};

class OpenclTracer : public Tracer {
public:
    explicit OpenclTracer(Entry entry) : entry_(std::move(entry)) {}
    Shape grain() const override { return entry_.grain; }
    Shape group() const override { return entry_.items; }
    unsigned most_in_flight() const override { return std::numeric_limits<unsigned>::max(); }
    unsigned most_samples() const override { return most_samples_of_launch(entry_.renderer.device.info); }
    std::size_t most_pixels() const override
    {
        const std::uint64_t bytes = entry_.renderer.device.info.max_allocation_bytes;
        return bytes ? bytes / pixel_bytes : std::numeric_limits<std::size_t>::max();
    }
    std::unique_ptr<Lane> make_lane(std::size_t pixels) override
    {
        return std::make_unique<OpenclLane>(entry_, pixels);
    }

private:
    Entry entry_;
};

} // namespace

std::unique_ptr<Tracer> make_opencl_tracer(const Renderer& renderer, const DeviceBuffers& buffers,
                                           const RenderSettings& settings)
{
    Entry entry{renderer, cl::Kernel(renderer.program.handle, "render"), {1, 1}, packet_block};
    for (cl_uint i = 0; i < BUFFER_COUNT; ++i) entry.kernel.setArg(i, buffers[i]);
    if (renderer.kernel == KernelShape::pixels) {
        entry.items = entry.grain = group_of(renderer, entry.kernel, settings.group);
    }
    return std::make_unique<OpenclTracer>(std::move(entry));
}

} // namespace clucida::host
