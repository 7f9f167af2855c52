#include "host/tiling.h"

#include <cmath>

namespace clucida::host {
namespace {

unsigned round_up(unsigned n, unsigned step)
{
    return (n + step - 1) / step * step;
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

Shape choose_tile(Shape picture, Shape group, double pixel_seconds, double budget_seconds, std::size_t most_pixels)
{
    const Shape whole = round_up(picture, group);
    const double affordable = pixel_seconds > 0 ? budget_seconds / pixel_seconds : 1e18;
    const double pixels = std::clamp(affordable, static_cast<double>(area(group)), static_cast<double>(most_pixels));
    if (pixels >= static_cast<double>(area(whole))) return whole;
    const auto side = static_cast<unsigned>(std::sqrt(pixels));
    Shape tile;
    tile.width = std::min(std::max(side / group.width, 1u) * group.width, whole.width);
    const auto rows = static_cast<unsigned>(std::min(pixels / tile.width, 65536.0));
    tile.height = std::min(std::max(rows / group.height, 1u) * group.height, whole.height);
    return tile;
}

} // namespace clucida::host
