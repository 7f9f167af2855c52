/// Scenes as storage in half precision would have them.
#pragma once

#include "bench/half.h"
#include "scene/compile.h"

#include <cstddef>

namespace clucida::bench {

/// The tree's boxes in halves, rounded outward, for kernels of bench/variants/half. The picture is the same.
scene::Compiled with_half_boxes(const scene::Compiled& compiled);

/// Floats of primitives and of objects' centres rounded to halves. The picture is what halves would make of it.
scene::Compiled with_half_coordinates(const scene::Compiled& compiled);

/// Likewise the floats of lights' colours, of media's extinction and of the sky. Filters are 32 bits of three channels
/// already, and texels 24.
scene::Compiled with_half_colors(const scene::Compiled& compiled);

/// What lies in floats that with_half_coordinates rounds, bytes.
std::size_t coordinate_bytes(const scene::Buffers& buffers);

} // namespace clucida::bench
