/// What implementations of OpenCL lack or do wrongly, and what is done about it: all that the host does lies here, told
/// by what a device says of itself, never by its name. docs/portability.md lists every fault with its report.
#pragma once

#include "host/device_choice.h"

#include <string>

namespace clucida::host {

/// Whether the device's compiler puts a copy of a function at each of its calls, so that large kernels take it minutes
/// and gigabytes: Mesa's does. A device without fma is taken to be one of its.
bool copies_calls(const DeviceInfo& device);

/// Samples of a pixel that a launch may take: where the loops of a work-item may turn so often only, one.
unsigned most_samples_of_launch(const DeviceInfo& device);

/// What work-items that are stuck mean on the device; empty if no more than that they are.
std::string explain_stuck(const DeviceInfo& device);

/// Options of the kernels' compiler that the device needs besides those of any other, each with a space before it.
std::string workaround_options(const DeviceInfo& device);

} // namespace clucida::host
