#include "bench/device_peak.h"

#include "host/errors.h"
#include "host/renderer.h"
#include "host/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace clucida::bench {
namespace {

constexpr unsigned rounds = 7, chains = 12;
constexpr unsigned repeats = 2000; ///< of the loop, whose chains are independent of each other
constexpr std::size_t most_group = 64, groups_a_unit = 32;

/// Numbers that nothing can foresee, for the factors are arguments.
std::string peak_source(host::Precision precision, unsigned lanes)
{
    const std::string element = precision == host::Precision::twofold ? "double" : "float";
    const std::string type = element + (lanes > 1 ? std::to_string(lanes) : "");
    std::string out;
    if (precision == host::Precision::twofold) out += "#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n";
    out += fmt::format("__kernel void peak(__global {0}* out, const {1} a, const {1} b, const uint count)\n{{\n", type,
                       element);
    for (unsigned i = 0; i < chains; ++i) out += fmt::format("    {} x{} = ({})(a + {});\n", type, i, type, i);
    out += fmt::format("    const {0} f = ({0})(a), g = ({0})(b);\n    for (uint i = 0; i < count; i++) {{\n", type);
    for (unsigned i = 0; i < chains; ++i) out += fmt::format("        x{0} = fma(x{0}, f, g);\n", i);
    out += "    }\n    out[get_global_id(0)] = x0";
    for (unsigned i = 1; i < chains; ++i) out += fmt::format(" + x{}", i);
    return out + ";\n}\n";
}

/// Of all processors together, s: on the host what they computed, for others may use them too.
template <typename Number>
double best_seconds(host::Renderer& renderer, const std::string& source, std::size_t items, std::size_t group,
                    unsigned lanes)
{
    const std::string options = host::base_options(renderer.device.info);
    const host::Program program =
        host::build_program(renderer.context, renderer.device, source, options, host::KernelCache::automatic);
    cl::Kernel kernel(program.handle, "peak");
    const cl::Buffer out(renderer.context, CL_MEM_WRITE_ONLY, items * lanes * sizeof(Number));
    kernel.setArg(0, out);
    kernel.setArg(1, Number(0.5));
    kernel.setArg(2, Number(0.25));
    kernel.setArg(3, cl_uint{repeats});
    const bool on_host = renderer.device.info.kind == host::DeviceKind::cpu;
    const unsigned units = std::max(renderer.device.info.compute_units, 1U);
    double best = 1e9;
    for (unsigned round = 0; round < rounds; ++round) {
        const host::Stopwatch watch;
        const host::CpuStopwatch processors;
        renderer.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(group));
        renderer.queue.finish();
        if (round == 0) continue; // it may generate code
        best = std::min(best, on_host ? processors.seconds() : watch.seconds() * units);
    }
    return best;
}

} // namespace

double measure_peak(const host::Device& device, host::Precision precision)
{
    try {
        host::Renderer renderer = host::make_renderer(device);
        const bool twofold = precision == host::Precision::twofold;
        const std::size_t group = std::min(std::max<std::size_t>(device.info.max_group, 1), most_group);
        const std::size_t items = groups_a_unit * group * std::max(device.info.compute_units, 1U);
        double out = 0;
        for (const unsigned lanes : {1U, 4U, 8U, 16U}) {
            const std::string source = peak_source(precision, lanes);
            const double seconds = twofold ? best_seconds<cl_double>(renderer, source, items, group, lanes)
                                           : best_seconds<cl_float>(renderer, source, items, group, lanes);
            out = std::max(out, 2.0 * lanes * chains * repeats * static_cast<double>(items) / seconds);
        }
        return out;
    } catch (const cl::Error& e) {
        throw host::Failure(fmt::format("{}: {}", host::describe(device.info), host::explain(e)));
    }
}

double measure_clock()
{
#if defined(__x86_64__)
    constexpr unsigned steps = 1000000, products = 4, cycles = 3; // a product takes three on all that are in use
    double best = 1e9;
    for (unsigned round = 0; round < rounds; ++round) {
        const host::Stopwatch watch;
        std::uint64_t x = 1;
        for (unsigned i = 0; i < steps; ++i)
            __asm__ volatile("imul $3, %0, %0\n\timul $3, %0, %0\n\timul $3, %0, %0\n\timul $3, %0, %0" : "+r"(x));
        best = std::min(best, watch.seconds());
    }
    return double{steps} * products * cycles / best;
#else
    return 0;
#endif
}

} // namespace clucida::bench
