/// Photographs as linear light, and how they are looked up.
#pragma once

#include "scene/model.h"

#include <array>
#include <memory>
#include <vector>

namespace clucida::oracle {

struct Image {
    unsigned width = 0, height = 0;
    bool interpolate = true;
    std::vector<std::array<double, 3>> texels; ///< rows from the top
};

/// @throws scene::Error if it cannot be read
std::shared_ptr<const Image> load_image(const scene::Photograph& photograph);

} // namespace clucida::oracle
