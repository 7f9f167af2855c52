#include "host/tiling.h"

#include <cmath>

namespace clucida::host {
namespace {

unsigned round_up(unsigned n, unsigned step)
{
    return (n + step - 1) / step * step;
}

/// At least one step.
unsigned round_down(double n, unsigned step)
{
    return std::max(static_cast<unsigned>(std::min(n, 65536.0)) / step, 1u) * step;
}

} // namespace

Shape round_up(Shape tile, Shape group)
{
    return {round_up(std::max(tile.width, 1u), group.width), round_up(std::max(tile.height, 1u), group.height)};
}

Shape choose_group(std::size_t most_items)
{
    Shape group{16, 4};
    while (area(group) > std::max<std::size_t>(most_items, 1)) {
        if (group.height > 1 && group.width <= 4 * group.height)
            group.height /= 2;
        else
            group.width /= 2;
    }
    return group;
}

Shape choose_tile(Shape picture, Shape group, double pixel_seconds, const TileLimits& limits)
{
    const Shape whole = round_up(picture, group);
    const double affordable = pixel_seconds > 0 ? limits.seconds / pixel_seconds : 1e18;
    const double pixels = std::clamp(affordable, static_cast<double>(area(group)), static_cast<double>(limits.pixels));
    if (pixels >= static_cast<double>(area(whole))) return whole;
    const unsigned most_rows = round_down(static_cast<double>(limits.band_pixels) / picture.width, group.height);
    const double side = std::max(std::sqrt(pixels), pixels / most_rows); // wider where it may not be as high
    Shape tile;
    tile.width = std::min(round_down(side, group.width), whole.width);
    tile.height = std::min({round_down(pixels / tile.width, group.height), most_rows, whole.height});
    return tile;
}

} // namespace clucida::host
