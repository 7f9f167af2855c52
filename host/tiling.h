/// How a frame is cut into launches: tiles of one shape, and runs of samples.
#pragma once

#include <algorithm>
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

/// The next multiple of the work-group's shape.
Shape round_up(Shape tile, Shape group);

/// The shape of a work-group of one-pixel items: 16x4, halved until the device and the kernel can take it.
Shape choose_group(std::size_t most_items);

/// What a launch may be: about so many seconds and at most so many pixels, and a row of tiles, which is what leaves for
/// the file at a time, as many pixels.
struct TileLimits {
    double seconds = 0.25;
    std::size_t pixels = std::size_t{1} << 20;
    std::size_t band_pixels = (std::size_t{64} << 20) / (3 * sizeof(float)); ///< 64 MiB
};

/// The shape of tile, a multiple of the group's, that keeps within the limits when a pixel takes pixel_seconds. No
/// larger than the picture needs, no smaller than the group.
Shape choose_tile(Shape picture, Shape group, double pixel_seconds, const TileLimits& limits);

/// The grid of tiles over a picture, row by row.
struct Tiling {
    Shape picture, tile;
    std::size_t columns() const { return (picture.width + tile.width - 1) / tile.width; }
    std::size_t rows() const { return (picture.height + tile.height - 1) / tile.height; }
    std::size_t count() const { return columns() * rows(); }
    unsigned x0(std::size_t i) const { return static_cast<unsigned>(i % columns()) * tile.width; }
    unsigned y0(std::size_t i) const { return static_cast<unsigned>(i / columns()) * tile.height; }
    /// What of the tile lies in the picture.
    Shape visible(std::size_t i) const
    {
        return {std::min(tile.width, picture.width - x0(i)), std::min(tile.height, picture.height - y0(i))};
    }
};

} // namespace clucida::host
