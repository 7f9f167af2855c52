/// Photographs: whatever stb_image reads, as packed texels.
#pragma once

#include "scene/model.h"

#include <cstdint>
#include <vector>

namespace clucida::scene {

struct Texels {
    unsigned width = 0, height = 0;
    std::vector<std::uint32_t> rgb; ///< 0x00BBGGRR, rows from the top
};

/// @throws Error at photograph.at if the file is missing, no picture, or larger than 16384 on a side
Texels load_photograph(const Photograph& photograph);

} // namespace clucida::scene
