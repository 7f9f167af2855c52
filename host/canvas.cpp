#include "host/canvas.h"

#include <algorithm>

namespace clucida::host {

Canvas::Canvas(Picture& picture, unsigned band_height, unsigned samples, const TakeRows& rows)
    : picture_(picture), band_height_(band_height), samples_(static_cast<float>(samples)), rows_(rows)
{
}

Canvas::Band Canvas::make_band(unsigned y) const
{
    const std::size_t pixels = std::size_t{picture_.width} * std::min(band_height_, picture_.height - y);
    return {std::vector<float>(3 * pixels), pixels};
}

float* Canvas::row(unsigned y)
{
    const std::size_t floats = std::size_t{3} * picture_.width;
    if (!rows_) return picture_.rgb.data() + y * floats;
    return bands_[(y - first_) / band_height_].rgb.data() + (y - first_) % band_height_ * floats;
}

void Canvas::add(const Region& region, std::span<const float> sums)
{
    const Shape part = region.visible({picture_.width, picture_.height});
    const std::lock_guard lock(mutex_);
    if (rows_)
        while (first_ + bands_.size() * band_height_ < region.y + part.height)
            bands_.push_back(make_band(static_cast<unsigned>(first_ + bands_.size() * band_height_)));
    for (unsigned j = 0; j < part.height; ++j) {
        const float* from = sums.data() + std::size_t{4} * region.shape.width * j;
        float* to = row(region.y + j) + std::size_t{3} * region.x;
        for (unsigned i = 0; i < part.width; ++i, from += 4, to += 3)
            for (int channel = 0; channel < 3; ++channel) to[channel] = from[channel] / samples_;
        if (rows_) bands_[(region.y + j - first_) / band_height_].missing -= part.width;
    }
}

void Canvas::hand_over()
{
    if (!rows_) return;
    const std::lock_guard in_order(handing_over_);
    for (;;) {
        Band band;
        unsigned y = 0;
        {
            const std::lock_guard lock(mutex_);
            if (bands_.empty() || bands_.front().missing > 0) return;
            band = std::move(bands_.front());
            bands_.pop_front();
            y = first_;
            first_ += band_height_;
        }
        rows_(y, band.rgb);
    }
}

} // namespace clucida::host
