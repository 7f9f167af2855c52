/// One number a pixel.
#pragma once

#include <cstddef>
#include <vector>

namespace clucida::host {

/// Rows from the top.
struct Plane {
    unsigned width = 0, height = 0;
    std::vector<float> value;
};

/// All zero. @throws std::bad_alloc
inline Plane make_plane(unsigned width, unsigned height)
{
    return {width, height, std::vector<float>(std::size_t{width} * height)};
}

} // namespace clucida::host
