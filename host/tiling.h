/// Shapes of pixels and of work-items.
#pragma once

#include <cstddef>

namespace clucida::host {

struct Shape {
    unsigned width = 0, height = 0;
    bool operator==(const Shape&) const = default;
};

inline std::size_t area(Shape s)
{
    return std::size_t{s.width} * s.height;
}

/// A launch takes no more samples of a pixel than this. A constant, so that sums are formed in the same order however
/// the frame is cut: the picture is the same to the byte.
constexpr unsigned samples_per_launch = 16;

/// The next multiple of the grain's shape, at least one.
Shape round_up(Shape shape, Shape grain);

/// The least shape that is a multiple of both.
Shape common_multiple(Shape a, Shape b);

/// The shape of a work-group of one-pixel items: 16x4, halved until the device and the kernel can take it.
Shape choose_group(std::size_t most_items);

} // namespace clucida::host
