/// The OpenCL devices of this computer.
#pragma once

#include "host/device_choice.h"
#include "host/opencl.h"

#include <string>
#include <vector>

namespace clucida::host {

struct Device {
    DeviceInfo info;
    cl::Device handle;
};

/// All devices of all platforms, in OpenCL's order, and the native one after them. Platforms without devices give none.
std::vector<Device> list_devices();

/// Their descriptions with " + " between.
std::string describe(std::span<const Device> devices);

std::vector<DeviceInfo> infos(const std::vector<Device>& devices);

/// The words that select a device: the flag, else the environment's CLUCIDA_DEVICE, else empty.
std::string device_selector(const std::string& flag);

/// The device that a selector means (device_choice.h). @throws Failure, UsageError
Device find_device(const std::string& selector);
/// Those that it means. @throws Failure, UsageError
std::vector<Device> find_devices(const std::string& selector);

} // namespace clucida::host
