#include "host/picture.h"

#include <algorithm>
#include <cmath>

namespace clucida::host {
namespace {

/// For bytes: threshold[k] is the least number that rounds to k, so that a byte is found without a power.
struct ByteTable {
    std::array<double, 257> threshold{};
    std::array<std::uint8_t, 4097> first{}; ///< the byte of i/4096, from which to go up

    explicit ByteTable(Transfer transfer)
    {
        for (int k = 1; k < 256; ++k) {
            const double half = (k - 0.5) / 255;
            threshold[k] = transfer == Transfer::srgb ? srgb_decode(half) : half;
        }
        threshold[0] = 0;
        threshold[256] = INFINITY;
        for (std::size_t i = 0, k = 0; i < first.size(); ++i) {
            while (static_cast<double>(i) / 4096 >= threshold[k + 1]) ++k;
            first[i] = static_cast<std::uint8_t>(k);
        }
    }
    std::uint8_t operator()(float value) const
    {
        if (!(value > 0)) return 0;
        if (value >= 1) return 255;
        std::size_t k = first[static_cast<std::size_t>(value * 4096)];
        while (value >= threshold[k + 1]) ++k;
        return static_cast<std::uint8_t>(k);
    }
};

} // namespace

Picture make_picture(unsigned width, unsigned height)
{
    return {width, height, std::vector<float>(std::size_t{3} * width * height)};
}

double srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::vector<std::uint8_t> develop_8(std::span<const float> rgb, Transfer transfer)
{
    const ByteTable table(transfer);
    std::vector<std::uint8_t> out(rgb.size());
    std::transform(rgb.begin(), rgb.end(), out.begin(), table);
    return out;
}

std::vector<std::uint16_t> develop_16(std::span<const float> rgb, Transfer transfer)
{
    std::vector<std::uint16_t> out(rgb.size());
    std::transform(rgb.begin(), rgb.end(), out.begin(), [transfer](float value) {
        const double x = value > 0 ? std::min(double{value}, 1.0) : 0.0;
        return static_cast<std::uint16_t>(std::lround((transfer == Transfer::srgb ? srgb_encode(x) : x) * 65535));
    });
    return out;
}

} // namespace clucida::host
