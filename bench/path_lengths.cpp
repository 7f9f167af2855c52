#include "bench/path_lengths.h"

#include "bench/speed_error.h"
#include "host/signatures.h"

#include <algorithm>

namespace clucida::bench {
namespace {

constexpr unsigned most_events = 1024; ///< of a pixel that are looked at

void count_event(const LayoutEvent& event, PathLengths& out)
{
    if (out.hops.size() <= event.hop) out.hops.resize(event.hop + 1);
    HopCount& hop = out.hops[event.hop];
    ++hop.rays;
    ++out.rays;
    if (event.object == EVENT_NONE) return;
    ++hop.hits;
    ++out.hits;
    const u32 followed = event.what & (EVENT_REFLECTED | EVENT_REFRACTED);
    if (followed == (EVENT_REFLECTED | EVENT_REFRACTED)) ++hop.branched;
    if (followed == 0) ++hop.ended;
}

void count_path(const host::PixelPath& path, PathLengths& out)
{
    u32 deepest = 0;
    for (const LayoutEvent& event : path.log) {
        count_event(event, out);
        deepest = std::max(deepest, event.hop);
    }
    if (!path.log.empty()) ++out.hops[deepest].deepest;
    out.unseen += path.events - path.log.size();
}

} // namespace

PathLengths measure_path_lengths(const host::Device& device, const scene::Compiled& compiled,
                                 const host::RenderSettings& settings, std::size_t most_pixels)
{
    host::Renderer renderer = host::make_renderer(device);
    host::PathTracer tracer = host::make_path_tracer(renderer, compiled, compiled.needs, settings);
    std::vector<host::Pixel> pixels;
    for (const std::size_t i : grid_pixels(settings.picture, most_pixels))
        pixels.push_back(
            {static_cast<cl_uint>(i % settings.picture.width), static_cast<cl_uint>(i / settings.picture.width)});
    host::Statistics counted;
    PathLengths out;
    out.pixels = pixels.size();
    for (const host::PixelPath& path : host::trace_paths(tracer, pixels, 0, most_events, counted))
        count_path(path, out);
    out.counted_rays = counted.rays;
    return out;
}

} // namespace clucida::bench
