/// What a device can do at most: the measure that a kernel's work is held to.
#pragma once

#include "host/devices.h"
#include "host/program.h"

namespace clucida::bench {

/// Floating-point operations a second of one of the device's processors: fma in a loop of independent vectors, in the
/// best of some widths and rounds. @throws host::Failure
double measure_peak(const host::Device& device, host::Precision precision);

/// Cycles a second of the processor that this thread runs on, by a chain of products that each wait for the one before;
/// 0 where it is not known how to do that.
double measure_clock();

} // namespace clucida::bench
