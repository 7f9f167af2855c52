/// The processor as a device without OpenCL: the kernels' C core, which the C++ compiler built into this program.
#pragma once

#include "host/device_choice.h"
#include "host/renderer.h"
#include "host/tracer.h"

namespace clucida::host {

/// With all features but the imitation of original programs, in float and in double. Not usable where the processor
/// lacks instructions that the program was built with.
DeviceInfo native_device();

/// Traces on all of the process's processors. compiled must outlive it.
/// @throws Failure if the core lacks what the scene needs
std::unique_ptr<Tracer> make_native_tracer(const scene::Compiled& compiled, const scene::Needs& needs,
                                           Precision precision, KernelShape kernel);

} // namespace clucida::host
