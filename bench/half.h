/// Numbers in half precision (IEEE 754 binary16: 11 bits, up to 65504).
#pragma once

#include <cstdint>

namespace clucida::bench {

inline constexpr double largest_half = 65504;

enum class Rounding { nearest, down, up };

/// The half's bits. Beyond the largest half is infinity, but for what is rounded towards 0.
std::uint16_t half_bits(double value, Rounding rounding);

/// The number that it is.
double half_value(std::uint16_t bits);

} // namespace clucida::bench
