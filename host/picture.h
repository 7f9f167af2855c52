/// A picture in linear light, and its development to bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace clucida::host {

/// Rows from the top, three floats a pixel: linear red, green, blue; 1 is white.
struct Picture {
    unsigned width = 0, height = 0;
    std::vector<float> rgb;
};

/// A black picture. @throws std::bad_alloc
Picture make_picture(unsigned width, unsigned height);

/// How numbers become bytes: sRGB's transfer function (IEC 61966-2-1), or none.
enum class Transfer { srgb, linear };

double srgb_encode(double linear); ///< 0..1 to 0..1
double srgb_decode(double encoded);

/// A byte for each number, clamped to 0..1 and rounded to nearest; what is not a number becomes 0.
std::vector<std::uint8_t> develop_8(std::span<const float> rgb, Transfer transfer);
inline std::vector<std::uint8_t> develop_8(const Picture& picture, Transfer transfer)
{
    return develop_8(std::span(picture.rgb), transfer);
}

/// The same in 16 bits, native order.
std::vector<std::uint16_t> develop_16(std::span<const float> rgb, Transfer transfer);
inline std::vector<std::uint16_t> develop_16(const Picture& picture, Transfer transfer)
{
    return develop_16(std::span(picture.rgb), transfer);
}

} // namespace clucida::host
