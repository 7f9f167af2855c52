#include "host/stereo.h"

#include "host/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace clucida::host {
namespace {

constexpr double usual_separation = 1.0 / 30; ///< of the screen's distance: what two people's eyes take without strain

} // namespace

StereoLayout parse_stereo(const std::string& name)
{
    if (name.empty()) return StereoLayout::none;
    if (name == "pair") return StereoLayout::pair;
    if (name == "side-by-side") return StereoLayout::side_by_side;
    if (name == "top-bottom") return StereoLayout::top_bottom;
    if (name == "anaglyph") return StereoLayout::anaglyph;
    throw UsageError(
        fmt::format("--stereo: '{}' is no kind of pair; expected pair, side-by-side, top-bottom or anaglyph", name));
}

std::vector<scene::View> eyes_of(const Stereo& stereo, const scene::Scene& scene, const scene::View& view)
{
    if (stereo.layout == StereoLayout::none) return {view};
    const double screen = stereo.screen.value_or(scene::view_distance(scene));
    const double half = stereo.separation.value_or(screen * usual_separation) / 2;
    std::vector<scene::View> out(2, view);
    out[0].eye = {-half, screen};
    out[1].eye = {half, screen};
    return out;
}

Shape composed_size(StereoLayout layout, Shape eye)
{
    if (layout == StereoLayout::side_by_side) eye.width *= 2;
    if (layout == StereoLayout::top_bottom) eye.height *= 2;
    return eye;
}

Picture compose(StereoLayout layout, std::vector<Picture> eyes)
{
    if (eyes.size() == 1) return std::move(eyes[0]);
    const Picture &left = eyes[0], &right = eyes[1];
    const Shape size = composed_size(layout, {left.width, left.height});
    Picture out = make_picture(size.width, size.height);
    const std::size_t row = std::size_t{3} * left.width;
    if (layout == StereoLayout::side_by_side) {
        for (std::size_t y = 0; y < left.height; ++y) {
            const auto at = [&](const Picture& p) { return p.rgb.begin() + static_cast<std::ptrdiff_t>(y * row); };
            const auto to = out.rgb.begin() + static_cast<std::ptrdiff_t>(2 * y * row);
            std::copy_n(at(right), row, std::copy_n(at(left), row, to));
        }
    } else if (layout == StereoLayout::top_bottom) {
        std::ranges::copy(right.rgb, std::ranges::copy(left.rgb, out.rgb.begin()).out);
    } else {
        for (std::size_t i = 0; i < out.rgb.size(); ++i) out.rgb[i] = i % 3 == 0 ? left.rgb[i] : right.rgb[i];
    }
    return out;
}

std::string eye_file(const std::string& file, std::size_t eye)
{
    const auto slash = file.rfind('/');
    const auto dot = file.rfind('.');
    const bool ends = dot != std::string::npos && (slash == std::string::npos || dot > slash);
    return file.substr(0, ends ? dot : file.size()) + (eye == 0 ? "_L" : "_R") + (ends ? file.substr(dot) : "");
}

} // namespace clucida::host
