#include "host/native_device.h"

#include "host/errors.h"
#include "host/share_work.h"
#include "kernels/native_api.h"
#include "kernels/packets/tile.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <limits>

namespace clucida::host {
namespace {

using Render = decltype(&native_render_f);

constexpr std::uint32_t imitations = scene::feature_as_gun | scene::feature_as_rayt;
constexpr unsigned side = PACKET_TILE; ///< of the blocks that threads take
constexpr unsigned packet_lanes = 8;

std::string processor_name()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            if (const auto at = line.find(": "); at != std::string::npos) return line.substr(at + 2);
    return "processor";
}

unsigned thread_count()
{
    return std::max(std::thread::hardware_concurrency(), 1U);
}

bool has_instructions()
{
#ifdef CLUCIDA_NATIVE_AVX2
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return true;
#endif
}

Render function(Precision precision, KernelShape kernel)
{
    const bool packets = kernel == KernelShape::packets;
    if (precision == Precision::twofold) return packets ? native_render_packets_d : native_render_d;
    return packets ? native_render_packets_f : native_render_f;
}

void require_capacities(const scene::Needs& needs)
{
    if (needs.features & imitations)
        throw Failure("the native device does not imitate original programs: --as-original needs an OpenCL device");
    const auto require = [](const char* what, unsigned needed, unsigned most) {
        if (needed > most)
            throw Failure(fmt::format("the scene needs a capacity of {} {}; the native device has {}: it takes an "
                                      "OpenCL device",
                                      needed, what, most));
    };
    require("objects about a point", needs.interior, native_capacities.interior);
    require("waiting rays", needs.stack, native_capacities.stack);
    require("groups of an object", needs.groups, native_capacities.groups);
    require("waiting boxes", needs.walk, native_capacities.walk);
}

class NativeLane : public Lane {
public:
    NativeLane(const scene::Compiled& compiled, Render render, Shape picture, std::size_t pixels)
        : render_(render), picture_(picture)
    {
        for (std::size_t i = 0; i < BUFFER_COUNT; ++i)
            scene_.buffers[i] = compiled.buffers.bytes[i].empty() ? nullptr : compiled.buffers.bytes[i].data();
        sums.resize(pixels * 4);
    }

    /// At once: there is nobody else to do it.
    void launch(const Region& region, unsigned begin, unsigned end, bool) override
    {
        const unsigned threads = thread_count();
        counters.assign(std::size_t{threads} * STAT_COUNT, 0);
        if (region.x >= picture_.width || region.y >= picture_.height) return;
        const Shape part = region.visible(picture_);
        const unsigned across = (part.width + side - 1) / side, down = (part.height + side - 1) / side;
        share_work(std::size_t{across} * down, threads, [&](std::size_t number, unsigned worker) {
            const auto x = static_cast<unsigned>(number % across) * side;
            const auto y = static_cast<unsigned>(number / across) * side;
            trace_block(region, {x, y, {std::min(side, part.width - x), std::min(side, part.height - y)}}, begin, end,
                        &counters[std::size_t{worker} * STAT_COUNT]);
        });
    }
    void wait() override {}

private:
    /// block: relative to the region. The core writes rows that lie one after the other.
    void trace_block(const Region& region, const Region& block, unsigned begin, unsigned end, std::uint32_t* stats)
    {
        std::array<float, std::size_t{4} * side * side> own{};
        const std::size_t stride = std::size_t{4} * region.shape.width, floats = std::size_t{4} * block.shape.width;
        float* const first = sums.data() + block.y * stride + std::size_t{4} * block.x;
        if (begin > 0)
            for (unsigned j = 0; j < block.shape.height; ++j) std::copy_n(first + j * stride, floats, &own[j * floats]);
        render_(&scene_, region.x + block.x, region.y + block.y, block.shape.width, block.shape.height, begin, end,
                own.data(), stats);
        for (unsigned j = 0; j < block.shape.height; ++j) std::copy_n(&own[j * floats], floats, first + j * stride);
    }

    NativeScene scene_{};
    Render render_;
    Shape picture_;
};

class NativeTracer : public Tracer {
public:
    NativeTracer(const scene::Compiled& compiled, Render render) : compiled_(compiled), render_(render)
    {
        const auto* frame = reinterpret_cast<const LayoutFrame*>(compiled.buffers.bytes[BUFFER_FRAME].data());
        picture_ = {frame->width, frame->height};
    }
    Shape grain() const override { return {side, side}; }
    unsigned most_in_flight() const override { return 1; }
    std::size_t most_pixels() const override { return std::numeric_limits<std::size_t>::max(); }
    std::unique_ptr<Lane> make_lane(std::size_t pixels) override
    {
        return std::make_unique<NativeLane>(compiled_, render_, picture_, pixels);
    }

private:
    const scene::Compiled& compiled_;
    Render render_;
    Shape picture_;
};

} // namespace

DeviceInfo native_device()
{
    DeviceInfo i;
    i.native = true;
    i.platform_name = "native";
    i.name = processor_name();
    i.version = "C11, built into clucida";
    i.driver = CLUCIDA_VERSION;
    i.kind = DeviceKind::cpu;
    i.compute_units = thread_count();
    i.global_bytes =
        static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGE_SIZE));
    i.usable = has_instructions();
    i.has_double = true;
    i.float_lanes = packet_lanes;
    i.rounds_division = true;
    return i;
}

std::unique_ptr<Tracer> make_native_tracer(const scene::Compiled& compiled, const scene::Needs& needs,
                                           Precision precision, KernelShape kernel)
{
    require_capacities(needs);
    return std::make_unique<NativeTracer>(compiled, function(precision, kernel));
}

} // namespace clucida::host
