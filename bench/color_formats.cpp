/// Which 32-bit format should hold a filter, and would halves be better? Random filters, packed and unpacked, alone and
/// as products of several: how far the product is off in steps of an 8-bit sRGB picture. Prints the table of
/// docs/numerics.md.
#include "bench/half.h"
#include "kernels/native_api.h"
#include "scene/pack.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <random>
#include <vector>

namespace {

using clucida::scene::Rgb;

double quantized(double v, double top)
{
    return std::round(v * top) / top;
}

Rgb linear_11_11_10(const Rgb& c)
{
    return {quantized(c.r, 2047), quantized(c.g, 2047), quantized(c.b, 1023)};
}

Rgb srgb_8(const Rgb& c)
{
    const auto channel = [](double v) {
        const double s = v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        return clucida::scene::srgb_decode(quantized(s, 255));
    };
    return {channel(c.r), channel(c.g), channel(c.b)};
}

/// Three mantissas of nine bits with a common exponent.
Rgb shared_exponent(const Rgb& c)
{
    const double most = std::max({c.r, c.g, c.b, 1e-9});
    const double unit = std::ldexp(1.0, std::max(-15, std::ilogb(most) + 1) - 9);
    const auto channel = [unit](double v) { return std::min(511.0, std::round(v / unit)) * unit; };
    return {channel(c.r), channel(c.g), channel(c.b)};
}

Rgb halves(const Rgb& c)
{
    const auto channel = [](double v) {
        return clucida::bench::half_value(clucida::bench::half_bits(v, clucida::bench::Rounding::nearest));
    };
    return {channel(c.r), channel(c.g), channel(c.b)};
}

/// The format in use, through the kernels' own unpacking.
Rgb square_roots(const Rgb& c)
{
    std::array<double, 3> out{};
    native_unpack_filter_f(clucida::scene::pack_filter(c), out.data());
    return {out[0], out[1], out[2]};
}

double steps(double v)
{
    return 255 * (v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

struct Error {
    double rms = 0, max = 0;
};

Error error_of(const std::function<Rgb(const Rgb&)>& format, int factors, bool dark)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto value = [&] { return dark ? std::pow(10, -2 * unit(random)) : unit(random); };
    Error error;
    constexpr int trials = 200000;
    for (int i = 0; i < trials; i++) {
        std::array<double, 3> exact{1, 1, 1}, packed{1, 1, 1};
        for (int k = 0; k < factors; k++) {
            const Rgb c{value(), value(), value()};
            const Rgb p = format(c);
            exact = {exact[0] * c.r, exact[1] * c.g, exact[2] * c.b};
            packed = {packed[0] * p.r, packed[1] * p.g, packed[2] * p.b};
        }
        for (int k = 0; k < 3; k++) {
            const double e = std::fabs(steps(exact[k]) - steps(packed[k]));
            error.rms += e * e / (3.0 * trials);
            error.max = std::max(error.max, e);
        }
    }
    error.rms = std::sqrt(error.rms);
    return error;
}

} // namespace

int main()
{
    const std::vector<std::pair<const char*, std::function<Rgb(const Rgb&)>>> formats{
        {"square roots 11-11-10 (in use)", square_roots},
        {"linear 11-11-10", linear_11_11_10},
        {"9-9-9 with a shared exponent of 5", shared_exponent},
        {"sRGB 8-8-8", srgb_8},
        {"three halves, 48 bits", halves},
    };
    fmt::print("| format | 1 filter: rms, max | 3 filters | 6 filters | 1 dark filter |\n|---|---|---|---|---|\n");
    for (const auto& [name, format] : formats) {
        fmt::print("| {} |", name);
        for (const auto& [factors, dark] : {std::pair{1, false}, {3, false}, {6, false}, {1, true}}) {
            const Error e = error_of(format, factors, dark);
            fmt::print(" {:.3f}, {:.2f} |", e.rms, e.max);
        }
        fmt::print("\n");
    }
}
