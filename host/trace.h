/// One frame traced by a team of devices.
#pragma once

#include "host/renderer.h"
#include "host/tracer.h"

#include <span>
#include <string>

namespace clucida::host {

/// A look at a few small tiles: how long a sample of a pixel takes, s; and what they look like, sums of one sample.
struct Probe {
    double sample_seconds = 0;
    std::vector<float> rgb; ///< the same pixels whatever the device
};

/// looks: at each tile, of which the fastest counts: others may hold one up. @throws cl::Error, Failure
Probe probe(Tracer& tracer, Shape picture, unsigned looks);

/// Launches for no samples at all and waits, so that whatever the implementation does at first is done.
void warm_up(Tracer& tracer);

struct Worker {
    Tracer* tracer = nullptr;
    double sample_seconds = 0;
    std::string failure = {}; ///< set if it failed on the way, and others took over
};

/// Traces the whole frame into frame.picture, or gives it to hooks.rows, and adds to frame.statistics; sets frame.tile,
/// frame.launches and frame.timings.rows. Each of several workers has a thread of its own; hooks are then called from
/// these, one at a time.
/// @throws Interrupted; cl::Error, Failure of the last worker that failed
void trace_frame(std::span<Worker> team, const RenderSettings& settings, const RenderHooks& hooks, Frame& frame);

} // namespace clucida::host
