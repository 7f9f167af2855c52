/// Pictures for two eyes.
#pragma once

#include "host/picture.h"
#include "host/tiling.h"
#include "scene/compile.h"

#include <optional>
#include <string>
#include <vector>

namespace clucida::host {

/// Two pictures (left and right), or both in one: beside each other, above each other, or for glasses of red (left) and
/// cyan.
enum class StereoLayout { none, pair, side_by_side, top_bottom, anaglyph };

struct Stereo {
    StereoLayout layout = StereoLayout::none;
    std::optional<double>
        separation;               ///< between the eyes, units of the scene; else a thirtieth of the screen's distance
    std::optional<double> screen; ///< its distance from the eyes; else that of the point looked at
};

/// "pair", "side-by-side", "top-bottom", "anaglyph", or empty for none. @throws UsageError
StereoLayout parse_stereo(const std::string& name);

/// The view of each eye, the left one first; or the view itself.
std::vector<scene::View> eyes_of(const Stereo& stereo, const scene::Scene& scene, const scene::View& view);

/// The size of a picture of both, each of that size.
Shape composed_size(StereoLayout layout, Shape eye);

/// One picture of the eyes' ones, which are of the same size; for `none` and `pair` the only one there is.
Picture compose(StereoLayout layout, std::vector<Picture> eyes);

/// The file of an eye of a pair: _L or _R before the ending.
std::string eye_file(const std::string& file, std::size_t eye);

} // namespace clucida::host
