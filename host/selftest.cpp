#include "host/selftest.h"

#include "host/errors.h"
#include "host/kernel_source.h"
#include "host/program.h"
#include "kernels/native_api.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace clucida::host {
namespace {

using Inputs = std::array<float, 4>;
using Results = std::array<float, 5>;
constexpr std::array<const char*, 5> names = {"a sum", "the error of a sum", "a product", "the error of a product",
                                              "a difference of products"};

/// Numbers of many magnitudes, and products that cancel, from a small generator (SplitMix64).
std::vector<Inputs> make_inputs()
{
    std::uint64_t state = 1;
    const auto next = [&state](int spread) {
        std::uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        const float mantissa = 1 + static_cast<float>(z & 0x7fffff) * 0x1p-23f;
        const int exponent = static_cast<int>(z >> 32 & 0xffff) % (2 * spread + 1) - spread;
        return std::ldexp(z >> 63 ? -mantissa : mantissa, exponent);
    };
    std::vector<Inputs> inputs;
    for (int i = 0; i < 512; ++i) {
        Inputs in = {next(12), next(12), next(12), next(12)};
        if (i % 2) { // nearly the same products
            in[2] = in[0] * (1 + 0x1p-20f);
            in[3] = in[1] * (1 - 0x1p-20f);
        }
        inputs.push_back(in);
    }
    return inputs;
}

/// What is right: doubles hold products of floats exactly, and sums of floats within 2^28 of each other.
Results exact(const Inputs& in)
{
    const double a = in[0], b = in[1], c = in[2], d = in[3];
    Results out{};
    out[0] = static_cast<float>(a + b);
    out[1] = static_cast<float>(a + b - out[0]);
    out[2] = static_cast<float>(a * b);
    out[3] = static_cast<float>(a * b - out[2]);
    const auto w = static_cast<float>(c * d);
    const auto e = static_cast<float>(w - c * d);
    out[4] = std::fma(in[0], in[1], -w) + e;
    return out;
}

std::string difference(const std::vector<Results>& results, const std::vector<Inputs>& inputs)
{
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const Results right = exact(inputs[i]);
        for (std::size_t k = 0; k < right.size(); ++k)
            if (std::bit_cast<std::uint32_t>(right[k]) != std::bit_cast<std::uint32_t>(results[i][k]))
                return fmt::format("{} of a={:a}, b={:a}, c={:a}, d={:a} is {:a}, should be {:a}", names[k],
                                   inputs[i][0], inputs[i][1], inputs[i][2], inputs[i][3], results[i][k], right[k]);
    }
    return {};
}

} // namespace

std::string self_test(const Device& device)
{
    const std::vector<Inputs> inputs = make_inputs();
    std::vector<Results> results(inputs.size());
    if (device.info.native) {
        for (std::size_t i = 0; i < inputs.size(); ++i) native_selftest(inputs[i].data(), results[i].data());
        return difference(results, inputs);
    }
    try {
        const cl::Context context(device.handle);
        const cl::CommandQueue queue(context, device.handle);
        const Program program = build_program(context, device, kernel_source("kernels/selftest.cl"),
                                              base_options(device.info), KernelCache::automatic);
        cl::Kernel kernel(program.handle, "selftest");
        const cl::Buffer in(context, CL_MEM_READ_ONLY, inputs.size() * sizeof(Inputs));
        const cl::Buffer out(context, CL_MEM_WRITE_ONLY, results.size() * sizeof(Results));
        queue.enqueueWriteBuffer(in, CL_TRUE, 0, inputs.size() * sizeof(Inputs), inputs.data());
        kernel.setArg(0, in);
        kernel.setArg(1, out);
        queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(inputs.size()));
        queue.enqueueReadBuffer(out, CL_TRUE, 0, results.size() * sizeof(Results), results.data());
        return difference(results, inputs);
    } catch (const cl::Error& e) {
        throw Failure(fmt::format("{}: {}", describe(device.info), explain(e)));
    }
}

} // namespace clucida::host
