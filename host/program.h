/// Kernels compiled for a device.
#pragma once

#include "host/devices.h"
#include "host/opencl.h"
#include "host/program_cache.h"
#include "scene/needs.h"

#include <string>

namespace clucida::host {

enum class Precision { single, twofold };

struct Program {
    cl::Program handle;
    std::string options;
    double build_seconds = 0;
    bool from_cache = false; ///< out of this program's own cache
    std::string note;        ///< why the cache did not serve, if it should have
};

/// The compiler's options for any kernel on this device: the language, exactness, and never fast mathematics.
std::string base_options(const DeviceInfo& device);

/// The options that select a scene's variant. @throws Failure if the device lacks the precision
std::string variant_options(const scene::Needs& needs, Precision precision, const DeviceInfo& device);

/// Compiles the source, or takes it from the cache.
/// @throws Failure with the compiler's errors, or its log where none can be told
Program build_program(const cl::Context& context, const Device& device, const std::string& source,
                      const std::string& options, KernelCache cache);

} // namespace clucida::host
