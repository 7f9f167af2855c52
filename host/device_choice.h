/// What OpenCL offers, as plain values, and the choice of a device by the user's words.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::host {

enum class DeviceKind { cpu, gpu, other };

const char* kind_name(DeviceKind kind); ///< "cpu", "gpu", "other"

struct DeviceInfo {
    unsigned platform = 0, device = 0; ///< the P:D of selectors, counted as OpenCL lists them
    std::string platform_name, platform_vendor, platform_version;
    std::string name, vendor, version, driver;
    DeviceKind kind = DeviceKind::other;
    unsigned compute_units = 0;
    std::uint64_t global_bytes = 0, max_allocation_bytes = 0;
    std::size_t max_group = 1; ///< work-items of a work-group
    bool native = false;       ///< no OpenCL device: the core that is built into this program (native_device.h)
    bool usable = true;        ///< available, with a compiler
    bool has_double = false;
    unsigned float_lanes = 1;     ///< floats of a vector register, as the implementation has it
    bool has_fma = true;          ///< fma is more than a routine
    bool rounds_division = false; ///< division and square root can be asked to be correctly rounded
};

/// How a selector names this very device: "0:0", "native".
std::string place(const DeviceInfo& device);

/// "0:0 pthread-haswell-AMD EPYC (Portable Computing Language)"
std::string describe(const DeviceInfo& device);

/// The devices that a selector means: "P:D", "cpu", "gpu", "all", "native", or a part of the name of the platform, the
/// device or their vendors, whatever the case; or several of these with commas between. Empty: the default, which is
/// the first GPU, else the first CPU, else any. "cpu" and "gpu" mean the first of their kind, "all" every OpenCL
/// device. Where OpenCL has none, the default, "cpu" and "all" mean the native device. Indices into devices, each once.
/// @throws Failure if nothing matches or several do; the message lists the devices
std::vector<std::size_t> choose_devices(std::span<const DeviceInfo> devices, std::string_view selector);

/// The same where only one will do. @throws UsageError where the selector means several
std::size_t choose_device(std::span<const DeviceInfo> devices, std::string_view selector);

/// @throws Failure if the device cannot do what `precision` double needs
void require_double(const DeviceInfo& device);

} // namespace clucida::host
