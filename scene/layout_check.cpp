/// Asserts that host and kernels see the same structs: no padding, offsets as the scalars before them add up to.
#include "kernels/layout.h"

#include <cstddef>
#include <type_traits>

namespace {
constexpr std::size_t words(std::size_t n)
{
    return 4 * n;
}
} // namespace

static_assert(sizeof(float) == words(1) && sizeof(u32) == words(1));
static_assert(sizeof(LayoutPlane) == words(4) && offsetof(LayoutPlane, h) == words(3));
static_assert(sizeof(LayoutSphere) == words(4) && offsetof(LayoutSphere, r) == words(3));
static_assert(sizeof(LayoutQuadric) == words(18) && offsetof(LayoutQuadric, m) == words(3));
static_assert(offsetof(LayoutQuadric, s) == words(12));
static_assert(offsetof(LayoutQuadric, g) == words(15) && offsetof(LayoutQuadric, w) == words(16));
static_assert(sizeof(LayoutTorus) == words(8) && offsetof(LayoutTorus, major) == words(6));
static_assert(sizeof(LayoutPlaneBlock) == words(40) && offsetof(LayoutPlaneBlock, h) == words(24));
static_assert(offsetof(LayoutPlaneBlock, plane) == words(32));
static_assert(sizeof(LayoutNode) == words(56) && offsetof(LayoutNode, child) == words(48));
static_assert(sizeof(LayoutGroup) == words(6));
static_assert(sizeof(LayoutObject) == words(16) && offsetof(LayoutObject, group_begin) == words(7));
static_assert(offsetof(LayoutObject, optics) == words(11) && offsetof(LayoutObject, texture) == words(12));
static_assert(offsetof(LayoutObject, sole) == words(13));
static_assert(sizeof(LayoutOptics) == words(9) && offsetof(LayoutOptics, extinction) == words(4));
static_assert(offsetof(LayoutOptics, flags) == words(7) && offsetof(LayoutOptics, rank) == words(8));
static_assert(sizeof(LayoutImage) == words(4));
static_assert(sizeof(LayoutTexture) == words(20) && offsetof(LayoutTexture, origin) == words(11));
static_assert(offsetof(LayoutTexture, scale) == words(14) && offsetof(LayoutTexture, reflection) == words(17));
static_assert(sizeof(LayoutLight) == words(6));
static_assert(sizeof(LayoutFrame) == words(37) && offsetof(LayoutFrame, forward) == words(2));
static_assert(offsetof(LayoutFrame, window) == words(11) && offsetof(LayoutFrame, cutoff) == words(15));
static_assert(offsetof(LayoutFrame, sky_image) == words(24) && offsetof(LayoutFrame, sky_axis) == words(25));
static_assert(std::is_trivially_copyable_v<LayoutFrame> && std::is_standard_layout_v<LayoutFrame>);
