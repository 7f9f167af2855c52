#include "host/program.h"

#include "host/build_log.h"
#include "host/errors.h"
#include "host/stopwatch.h"
#include "host/workarounds.h"

#include <fmt/format.h>

namespace clucida::host {
namespace {

/// The log, not beyond what a person would read.
std::string shortened(const std::string& log)
{
    constexpr std::size_t most = 8000;
    return log.size() <= most ? log : log.substr(0, most) + "\n... (the log goes on)";
}

std::string build_log(const cl::Program& program, const cl::Device& device)
{
    try {
        return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
    } catch (const cl::Error&) {
        return {};
    }
}

[[noreturn]] void report(const cl::Program& program, const Device& device, const std::string& source,
                         const std::string& options, const cl::Error& error)
{
    const std::string log = name_files(build_log(program, device.handle), source);
    const std::string summary = summarise_log(log);
    throw Failure(fmt::format("the kernels could not be compiled for {}: {}\noptions: {}\n{}", describe(device.info),
                              cl_error_name(error.err()), options, summary.empty() ? shortened(log) : summary));
}

bool build_cached(Program& program, const cl::Context& context, const Device& device, const std::string& binary)
{
    try {
        const std::vector<unsigned char> bytes(binary.begin(), binary.end());
        program.handle = cl::Program(context, {device.handle}, {bytes});
        program.handle.build({device.handle}, program.options.c_str());
        return program.from_cache = true;
    } catch (const cl::Error& e) {
        program.note = fmt::format("a cached kernel was refused ({}), compiled anew", cl_error_name(e.err()));
        return false;
    }
}

void build_source(Program& program, const cl::Context& context, const Device& device, const std::string& source)
{
    program.handle = cl::Program(context, source);
    try {
        program.handle.build({device.handle}, program.options.c_str());
    } catch (const cl::Error& e) { // a BuildError where the compiler complained
        report(program.handle, device, source, program.options, e);
    }
}

void keep(Program& program, const std::string& key)
{
    try {
        const auto binaries = program.handle.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.empty() || binaries.front().empty()) return;
        const std::string binary(binaries.front().begin(), binaries.front().end());
        if (!store_cached(cache_folder(), key, binary)) program.note = "the kernel cache cannot be written";
    } catch (const cl::Error& e) {
        program.note = fmt::format("the compiled kernel could not be had ({})", cl_error_name(e.err()));
    }
}

} // namespace

std::string base_options(const DeviceInfo& device)
{
    std::string options = "-cl-std=CL1.2";
    if (device.rounds_division) options += " -cl-fp32-correctly-rounded-divide-sqrt";
    return options + workaround_options(device);
}

std::string variant_options(const scene::Needs& needs, Precision precision, const DeviceInfo& device)
{
    std::string options = base_options(device) + " " + scene::build_options(needs);
    if (precision == Precision::twofold) {
        require_double(device);
        options += " -DCLU_DOUBLE";
    }
    return options;
}

Program build_program(const cl::Context& context, const Device& device, const std::string& source,
                      const std::string& options, KernelCache cache)
{
    if (device.info.native) throw Failure("this needs an OpenCL device: kernels are not compiled for `native`");
    const Stopwatch watch;
    Program program;
    program.options = options;
    const bool caching = uses_cache(cache, device.info);
    const std::string key = caching ? cache_key(source, options, device.info) : "";
    const auto cached = caching ? load_cached(cache_folder(), key) : std::nullopt;
    if (!cached || !build_cached(program, context, device, *cached)) {
        build_source(program, context, device, source);
        if (caching) keep(program, key);
    }
    program.build_seconds = watch.seconds();
    return program;
}

} // namespace clucida::host
