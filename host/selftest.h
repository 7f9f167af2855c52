/// Whether exact arithmetic survives a device's compiler.
#pragma once

#include "host/devices.h"

#include <string>

namespace clucida::host {

/// Builds and runs kernels/selftest.h: two-sum, the error of a product, and the difference of products, each compared
/// with the exact result bit for bit. Empty if all is right, else what is wrong.
/// @throws Failure if the device fails
std::string self_test(const Device& device);

} // namespace clucida::host
