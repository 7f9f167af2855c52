#include "bench/oracle/image.h"

#include "scene/photograph.h"

#include <cmath>

namespace clucida::oracle {
namespace {

/// IEC 61966-2-1.
double srgb_to_linear(double v)
{
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

} // namespace

std::shared_ptr<const Image> load_image(const scene::Photograph& photograph)
{
    const scene::Texels bytes = scene::load_photograph(photograph);
    const auto light = [&](std::uint32_t byte) {
        const double v = (byte & 255U) / 255.0;
        return photograph.linear ? v : srgb_to_linear(v);
    };
    auto image = std::make_shared<Image>();
    image->width = bytes.width;
    image->height = bytes.height;
    image->interpolate = photograph.interpolate;
    image->texels.reserve(bytes.rgb.size());
    for (const std::uint32_t texel : bytes.rgb)
        image->texels.push_back({light(texel), light(texel >> 8U), light(texel >> 16U)});
    return image;
}

} // namespace clucida::oracle
