/// The paths of a picture's pixels, as the kernels' signature variant tells them (kernels/signature.h).
#pragma once

#include "host/renderer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace clucida::host {

/// As kernels take it: a uint2.
struct Pixel {
    cl_uint x = 0, y = 0;
};

/// As the kernels traced it, in their precision: the origin relative to the observer's eye, the direction nearly of
/// length 1, and the product of the surfaces' filters until its start.
struct SegmentRay {
    std::array<double, 3> o{}, d{}, throughput{};
};

/// One sample of one pixel.
struct PixelPath {
    std::array<float, 3> rgb{};   ///< linear light, as the picture has it
    std::uint32_t events = 0;     ///< how many there were
    std::uint32_t hash = 0;       ///< of all of them
    std::vector<LayoutEvent> log; ///< the first of them, up to the capacity asked for
    std::vector<SegmentRay> rays; ///< those that the events of the log began with, if they were asked for
};

enum class KeepRays : bool { no, yes };

/// The signature variant of a scene's kernel, ready to trace.
struct PathTracer {
    Renderer& renderer;
    DeviceBuffers buffers;
    cl::Kernel kernel;
    Precision precision = Precision::single;
};

/// needs: as they sufficed for the frame (Frame::needs). @throws Failure
PathTracer make_path_tracer(Renderer& renderer, const scene::Compiled& compiled, const scene::Needs& needs,
                            const RenderSettings& settings);

/// Traces that sample of each pixel; of each path the first `capacity` events are kept, and their rays if those
/// are asked for. Adds to statistics.
/// @throws Failure
std::vector<PixelPath> trace_paths(PathTracer& tracer, std::span<const Pixel> pixels, unsigned sample,
                                   unsigned capacity, Statistics& statistics, KeepRays keep_rays = KeepRays::no);

} // namespace clucida::host
