#include "host/tiling.h"

#include <algorithm>
#include <numeric>

namespace clucida::host {
namespace {

unsigned round_up(unsigned n, unsigned step)
{
    return (n + step - 1) / step * step;
}

} // namespace

Shape round_up(Shape shape, Shape grain)
{
    return {round_up(std::max(shape.width, 1u), grain.width), round_up(std::max(shape.height, 1u), grain.height)};
}

Shape common_multiple(Shape a, Shape b)
{
    return {std::lcm(a.width, b.width), std::lcm(a.height, b.height)};
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

} // namespace clucida::host
