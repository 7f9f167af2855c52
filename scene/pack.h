/// Colours in 32 bits, as kernels/color.h reads them.
#pragma once

#include "scene/model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace clucida::scene {

/// r, g, b in 0..1: their square roots at 11, 11, 10 bits.
inline std::uint32_t pack_filter(const Rgb& c)
{
    const auto code = [](double v, double top) {
        return static_cast<std::uint32_t>(std::lround(std::sqrt(std::clamp(v, 0.0, 1.0)) * top));
    };
    return code(c.r, 2047) | code(c.g, 2047) << 11 | code(c.b, 1023) << 22;
}

/// sRGB's decoding function (IEC 61966-2-1), 0..1 to 0..1.
inline double srgb_decode(double v)
{
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// A filter's value as the original program keeps it: a byte.
inline double rounded_to_byte(double v)
{
    return std::round(v * 255) / 255;
}

} // namespace clucida::scene
