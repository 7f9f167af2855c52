/// Asserts that host and kernels see the same structs: no padding, offsets as the scalars before them add up to.
#include "kernels/layout.h"

#include <cstddef>
#include <type_traits>

static_assert(sizeof(float) == 4 && sizeof(u32) == 4);
static_assert(sizeof(LayoutPlane) == 4 * 4 && offsetof(LayoutPlane, h) == 3 * 4);
static_assert(sizeof(LayoutSphere) == 4 * 4 && offsetof(LayoutSphere, r) == 3 * 4);
static_assert(sizeof(LayoutQuadric) == 26 * 4 && offsetof(LayoutQuadric, m) == 3 * 4);
static_assert(offsetof(LayoutQuadric, cof) == 12 * 4 && offsetof(LayoutQuadric, s) == 21 * 4);
static_assert(offsetof(LayoutQuadric, g) == 24 * 4 && offsetof(LayoutQuadric, w) == 25 * 4);
static_assert(sizeof(LayoutGroup) == 3 * 4);
static_assert(sizeof(LayoutObject) == 11 * 4 && offsetof(LayoutObject, group_begin) == 5 * 4);
static_assert(offsetof(LayoutObject, optics) == 9 * 4 && offsetof(LayoutObject, texture) == 10 * 4);
static_assert(sizeof(LayoutOptics) == 9 * 4 && offsetof(LayoutOptics, extinction) == 4 * 4);
static_assert(offsetof(LayoutOptics, flags) == 7 * 4 && offsetof(LayoutOptics, rank) == 8 * 4);
static_assert(sizeof(LayoutImage) == 4 * 4);
static_assert(sizeof(LayoutTexture) == 20 * 4 && offsetof(LayoutTexture, origin) == 11 * 4);
static_assert(offsetof(LayoutTexture, scale) == 14 * 4 && offsetof(LayoutTexture, reflection) == 17 * 4);
static_assert(sizeof(LayoutLight) == 6 * 4);
static_assert(sizeof(LayoutFrame) == 35 * 4 && offsetof(LayoutFrame, forward) == 2 * 4);
static_assert(offsetof(LayoutFrame, window) == 11 * 4 && offsetof(LayoutFrame, cutoff) == 15 * 4);
static_assert(offsetof(LayoutFrame, sky_image) == 22 * 4 && offsetof(LayoutFrame, sky_axis) == 23 * 4);
static_assert(std::is_trivially_copyable_v<LayoutFrame> && std::is_standard_layout_v<LayoutFrame>);
