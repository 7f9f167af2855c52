/// The launches of one frame: several in flight, each a tile and a run of samples.
#pragma once

#include "host/opencl.h"
#include "host/renderer.h"

namespace clucida::host {

/// A kernel with the scene's buffers set, ready for tiles.
struct Tracer {
    const cl::Context& context;
    const cl::CommandQueue& queue;
    cl::Kernel& kernel;
    Shape items; ///< of a work-group
    Shape block; ///< pixels of an item
    Profiling profiling = Profiling::no;
    /// The pixels of a work-group.
    Shape group() const { return {items.width * block.width, items.height * block.height}; }
};

/// Launches the kernel for no samples at all and waits, so that whatever the implementation does at first is done.
void warm_up(Tracer& tracer);

/// Seconds that one sample of a pixel takes, measured on a few small tiles.
double measure_sample(Tracer& tracer, Shape picture);

/// Traces the whole frame into frame.picture, or gives it to hooks.rows, and adds to frame.statistics; sets
/// frame.launches and frame.timings.rows.
/// @throws cl::Error, Interrupted
void trace_tiles(Tracer& tracer, const Tiling& tiling, const RenderSettings& settings, const RenderHooks& hooks,
                 Frame& frame);

} // namespace clucida::host
