/// Regions traced by an OpenCL device.
#pragma once

#include "host/renderer.h"
#include "host/tracer.h"

namespace clucida::host {

/// The renderer's program with the scene's buffers; groups are as the settings say, else as the renderer. renderer and
/// buffers must outlive it. @throws cl::Error, Failure
std::unique_ptr<Tracer> make_opencl_tracer(const Renderer& renderer, const DeviceBuffers& buffers,
                                           const RenderSettings& settings);

} // namespace clucida::host
