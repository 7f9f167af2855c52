#include "host/devices.h"

#include "host/native_device.h"

#include <cstdlib>

namespace clucida::host {
namespace {

/// A piece of information that implementations may fail to give; then its default.
template <cl_int Name, class Handle>
auto info_or_default(const Handle& handle) -> decltype(handle.template getInfo<Name>())
{
    try {
        return handle.template getInfo<Name>();
    } catch (const cl::Error&) {
        return {};
    }
}

std::string trimmed(std::string s)
{
    while (!s.empty() && (s.back() == '\0' || s.back() == ' ' || s.back() == '\n')) s.pop_back();
    s.erase(0, std::min(s.find_first_not_of(" \n"), s.size()));
    return s;
}

DeviceKind kind_of(cl_device_type type)
{
    if (type & CL_DEVICE_TYPE_GPU) return DeviceKind::gpu;
    if (type & CL_DEVICE_TYPE_CPU) return DeviceKind::cpu;
    return DeviceKind::other;
}

DeviceInfo info_of(const cl::Platform& platform, const cl::Device& device)
{
    DeviceInfo i;
    i.platform_name = trimmed(info_or_default<CL_PLATFORM_NAME>(platform));
    i.platform_vendor = trimmed(info_or_default<CL_PLATFORM_VENDOR>(platform));
    i.platform_version = trimmed(info_or_default<CL_PLATFORM_VERSION>(platform));
    i.name = trimmed(info_or_default<CL_DEVICE_NAME>(device));
    i.vendor = trimmed(info_or_default<CL_DEVICE_VENDOR>(device));
    i.version = trimmed(info_or_default<CL_DEVICE_VERSION>(device));
    i.driver = trimmed(info_or_default<CL_DRIVER_VERSION>(device));
    i.kind = kind_of(info_or_default<CL_DEVICE_TYPE>(device));
    i.compute_units = info_or_default<CL_DEVICE_MAX_COMPUTE_UNITS>(device);
    i.global_bytes = info_or_default<CL_DEVICE_GLOBAL_MEM_SIZE>(device);
    i.max_allocation_bytes = info_or_default<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(device);
    i.max_group = info_or_default<CL_DEVICE_MAX_WORK_GROUP_SIZE>(device);
    i.float_lanes = info_or_default<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>(device);
    i.usable = info_or_default<CL_DEVICE_AVAILABLE>(device) && info_or_default<CL_DEVICE_COMPILER_AVAILABLE>(device);
    i.has_double = info_or_default<CL_DEVICE_DOUBLE_FP_CONFIG>(device) != 0;
    // Intel's runtime says so of doubles only, and has one instruction for either.
    i.has_fma =
        ((info_or_default<CL_DEVICE_SINGLE_FP_CONFIG>(device) | info_or_default<CL_DEVICE_DOUBLE_FP_CONFIG>(device)) &
         CL_FP_FMA) != 0;
    i.rounds_division =
        (info_or_default<CL_DEVICE_SINGLE_FP_CONFIG>(device) & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    return i;
}

} // namespace

std::vector<Device> list_devices()
{
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        platforms.clear(); // the loader's way (-1001) to say that there is none
    }
    std::vector<Device> out;
    for (unsigned p = 0; p < platforms.size(); ++p) {
        std::vector<cl::Device> devices;
        try {
            platforms[p].getDevices(CL_DEVICE_TYPE_ALL, &devices);
        } catch (const cl::Error&) {
            continue; // a platform without devices, or one that is broken: as good as absent
        }
        for (unsigned d = 0; d < devices.size(); ++d) {
            DeviceInfo info = info_of(platforms[p], devices[d]);
            info.platform = p;
            info.device = d;
            out.push_back({std::move(info), devices[d]});
        }
    }
    out.push_back({native_device(), {}});
    return out;
}

std::string describe(std::span<const Device> devices)
{
    std::string out;
    for (const Device& d : devices) out += (out.empty() ? "" : " + ") + describe(d.info);
    return out;
}

std::vector<DeviceInfo> infos(const std::vector<Device>& devices)
{
    std::vector<DeviceInfo> out;
    out.reserve(devices.size());
    for (const Device& d : devices) out.push_back(d.info);
    return out;
}

std::string device_selector(const std::string& flag)
{
    if (!flag.empty()) return flag;
    const char* environment = std::getenv("CLUCIDA_DEVICE");
    return environment ? environment : "";
}

Device find_device(const std::string& selector)
{
    std::vector<Device> devices = list_devices();
    return devices[choose_device(infos(devices), selector)];
}

std::vector<Device> find_devices(const std::string& selector)
{
    const std::vector<Device> devices = list_devices();
    std::vector<Device> out;
    for (const std::size_t i : choose_devices(infos(devices), selector)) out.push_back(devices[i]);
    return out;
}

} // namespace clucida::host
