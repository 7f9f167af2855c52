#include "bench/half.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clucida::bench {
namespace {

constexpr int mantissa_bits = 10, least_exponent = -14, exponent_bias = 15;
constexpr std::uint16_t sign_bit = 0x8000, infinity_bits = 0x7c00;

double rounded(double v, Rounding rounding)
{
    switch (rounding) {
    case Rounding::down: return std::floor(v);
    case Rounding::up: return std::ceil(v);
    case Rounding::nearest: break;
    }
    return std::nearbyint(v); // to even
}

} // namespace

std::uint16_t half_bits(double value, Rounding rounding)
{
    const std::uint16_t sign = std::signbit(value) ? sign_bit : 0;
    const double magnitude = std::fabs(value);
    const bool outward = rounding == (sign ? Rounding::down : Rounding::up);
    if (std::isinf(value)) return sign | infinity_bits;
    if (magnitude == 0) return sign;
    const int exponent = std::max(std::ilogb(magnitude), least_exponent);
    const double unit = std::ldexp(1.0, exponent - mantissa_bits);
    const double out = std::fabs(rounded(value / unit, rounding)) * unit;
    if (out > largest_half) {
        const bool over = outward || rounding == Rounding::nearest;
        return sign | (over ? infinity_bits : infinity_bits - 1U);
    }
    if (out == 0) return sign;
    const int e = std::max(std::ilogb(out), least_exponent);
    const auto mantissa = static_cast<unsigned>(std::ldexp(out, mantissa_bits - e)); // 1024..2047, less if subnormal
    const unsigned biased = mantissa >= 1U << mantissa_bits ? static_cast<unsigned>(e + exponent_bias) : 0U;
    return static_cast<std::uint16_t>(sign | (biased << mantissa_bits) | (mantissa & ((1U << mantissa_bits) - 1U)));
}

double half_value(std::uint16_t bits)
{
    const int exponent = bits >> mantissa_bits & 31, mantissa = bits & ((1 << mantissa_bits) - 1);
    const double sign = bits & sign_bit ? -1 : 1;
    if (exponent == 31) return mantissa ? std::nan("") : sign * std::numeric_limits<double>::infinity();
    if (exponent == 0) return sign * std::ldexp(mantissa, least_exponent - mantissa_bits);
    return sign * std::ldexp(mantissa + (1 << mantissa_bits), exponent - exponent_bias - mantissa_bits);
}

} // namespace clucida::bench
