#include "host/signatures.h"

#include "host/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace clucida::host {
namespace {

constexpr std::size_t stats_count = std::size_t{STAT_SLOTS} * STAT_COUNT;
constexpr std::size_t most_events = std::size_t{1} << 22; ///< of a launch: 80 MiB
constexpr std::size_t most_rays = std::size_t{1} << 20;   ///< likewise
constexpr std::size_t most_pixels = std::size_t{1} << 14; ///< likewise

/// Of a path, as the kernel writes it: a uint2.
struct Signature {
    cl_uint events = 0, hash = 0;
};

std::array<double, 3> three(const auto* numbers)
{
    return {double{numbers[0]}, double{numbers[1]}, double{numbers[2]}};
}

/// Reads `capacity` rays of each path, of which the first are there.
template <typename Number>
void read_rays(const cl::CommandQueue& queue, const cl::Buffer& buffer, unsigned capacity, std::span<PixelPath> out)
{
    std::vector<Number> numbers(out.size() * capacity * RAY_NUMBERS);
    queue.enqueueReadBuffer(buffer, CL_TRUE, 0, numbers.size() * sizeof(Number), numbers.data());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Number* at = &numbers[i * capacity * RAY_NUMBERS];
        out[i].rays.reserve(out[i].log.size());
        for (std::size_t k = 0; k < out[i].log.size(); ++k, at += RAY_NUMBERS)
            out[i].rays.push_back({three(at), three(at + 3), three(at + 6)});
    }
}

void trace_batch(PathTracer& t, std::span<const Pixel> pixels, unsigned sample, unsigned capacity, KeepRays keep_rays,
                 std::span<PixelPath> out, Statistics& statistics)
{
    const std::size_t count = pixels.size(), events = std::max<std::size_t>(count * capacity, 1);
    const unsigned ray_capacity = keep_rays == KeepRays::yes ? capacity : 0;
    const bool twofold = t.precision == Precision::twofold;
    const std::size_t ray_bytes = RAY_NUMBERS * (twofold ? sizeof(cl_double) : sizeof(cl_float));
    const cl::Context& context = t.renderer.context;
    const cl::CommandQueue& queue = t.renderer.queue;
    std::vector<Pixel> places(pixels.begin(), pixels.end());
    const cl::Buffer place_buffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, count * sizeof(Pixel),
                                  places.data());
    const cl::Buffer colors(context, CL_MEM_WRITE_ONLY, count * 4 * sizeof(float));
    const cl::Buffer signatures(context, CL_MEM_WRITE_ONLY, count * sizeof(Signature));
    const cl::Buffer log(context, CL_MEM_WRITE_ONLY, events * sizeof(LayoutEvent));
    const cl::Buffer rays(context, CL_MEM_WRITE_ONLY, std::max<std::size_t>(count * ray_capacity, 1) * ray_bytes);
    std::vector<std::uint32_t> rows(stats_count); // written, not filled: Oclgrind takes what is filled for unset
    const cl::Buffer stats(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, rows.size() * sizeof(cl_uint),
                           rows.data());

    cl_uint argument = BUFFER_COUNT;
    t.kernel.setArg(argument++, place_buffer);
    t.kernel.setArg(argument++, static_cast<cl_uint>(count));
    t.kernel.setArg(argument++, cl_uint{sample});
    t.kernel.setArg(argument++, cl_uint{capacity});
    t.kernel.setArg(argument++, cl_uint{ray_capacity});
    t.kernel.setArg(argument++, colors);
    t.kernel.setArg(argument++, signatures);
    t.kernel.setArg(argument++, log);
    t.kernel.setArg(argument++, rays);
    t.kernel.setArg(argument, stats);
    enqueue_each(t.renderer, t.kernel, count);

    std::vector<float> rgba(count * 4);
    std::vector<Signature> found(count);
    std::vector<LayoutEvent> found_events(capacity ? events : 0);
    queue.enqueueReadBuffer(colors, CL_TRUE, 0, rgba.size() * sizeof(float), rgba.data());
    queue.enqueueReadBuffer(signatures, CL_TRUE, 0, found.size() * sizeof(Signature), found.data());
    queue.enqueueReadBuffer(stats, CL_TRUE, 0, rows.size() * sizeof(cl_uint), rows.data());
    if (capacity)
        queue.enqueueReadBuffer(log, CL_TRUE, 0, found_events.size() * sizeof(LayoutEvent), found_events.data());
    add_rows(statistics, rows);
    for (std::size_t i = 0; i < count; ++i) {
        std::copy_n(rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, out[i].rgb.begin());
        out[i].events = found[i].events;
        out[i].hash = found[i].hash;
        const auto first = found_events.begin() + static_cast<std::ptrdiff_t>(i * capacity);
        out[i].log.assign(first, first + std::min(found[i].events, capacity));
    }
    if (ray_capacity == 0) return;
    if (twofold)
        read_rays<cl_double>(queue, rays, ray_capacity, out);
    else
        read_rays<cl_float>(queue, rays, ray_capacity, out);
}

} // namespace

PathTracer make_path_tracer(Renderer& renderer, const scene::Compiled& compiled, const scene::Needs& needs,
                            const RenderSettings& settings)
{
    try {
        const std::string options =
            variant_options(needs, settings.precision, renderer.device.info) + " -DCLU_SIGNATURE";
        const Program program =
            build_program(renderer.context, renderer.device, resolve_includes("kernels/signature.cl", settings.kernels),
                          options, settings.cache);
        PathTracer tracer{renderer, upload(renderer, compiled.buffers), cl::Kernel(program.handle, "signature"),
                          settings.precision};
        for (cl_uint i = 0; i < BUFFER_COUNT; ++i) tracer.kernel.setArg(i, tracer.buffers[i]);
        return tracer;
    } catch (const cl::Error& e) {
        throw Failure(fmt::format("{}: {}", describe(renderer.device.info), explain(e)));
    }
}

std::vector<PixelPath> trace_paths(PathTracer& tracer, std::span<const Pixel> pixels, unsigned sample,
                                   unsigned capacity, Statistics& statistics, KeepRays keep_rays)
{
    const std::size_t most = keep_rays == KeepRays::yes ? most_rays : most_events;
    const std::size_t step = capacity ? std::clamp<std::size_t>(most / capacity, 1, most_pixels) : most_pixels;
    std::vector<PixelPath> out(pixels.size());
    try {
        for (std::size_t i = 0; i < pixels.size(); i += step) {
            const std::size_t count = std::min(step, pixels.size() - i);
            trace_batch(tracer, pixels.subspan(i, count), sample, capacity, keep_rays, std::span(out).subspan(i, count),
                        statistics);
        }
    } catch (const cl::Error& e) {
        throw Failure(fmt::format("{}: {}", describe(tracer.renderer.device.info), explain(e)));
    }
    return out;
}

} // namespace clucida::host
