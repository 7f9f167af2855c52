#include "bench/half_storage.h"

#include <cmath>
#include <cstring>
#include <vector>

namespace clucida::bench {
namespace {

float to_half(float v)
{
    if (std::fabs(v) > largest_half) return v; // all of space (LayoutPlaneBlock), or no bounding sphere
    return static_cast<float>(half_value(half_bits(v, Rounding::nearest)));
}

template <std::size_t N>
void to_halves(float (&values)[N])
{
    for (float& v : values) v = to_half(v);
}

template <typename Item>
std::vector<Item> items_of(const scene::Buffers& buffers, LayoutBuffer which)
{
    const scene::Bytes& bytes = buffers.bytes[which];
    std::vector<Item> out(bytes.size() / sizeof(Item));
    if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
}

/// Changes each of a buffer's items.
template <typename Item, typename Change>
void change(scene::Buffers& buffers, LayoutBuffer which, const Change& each)
{
    auto items = items_of<Item>(buffers, which);
    for (Item& item : items) each(item);
    buffers.bytes[which] = scene::Bytes(std::move(items));
}

/// As LayoutNode in bench/variants/half.
struct HalfNode {
    std::uint16_t bounds[6][8];
    u32 child[8];
};

/// What an object's centre moves by must not take anything out of its bounding sphere.
void move_center(LayoutObject& object)
{
    double moved = 0;
    for (float& c : object.center) {
        const float half = to_half(c);
        moved += std::fabs(double{half} - double{c});
        c = half;
    }
    constexpr double slack = 1.002; // its members are rounded to 2^-11 of their lengths
    object.radius = static_cast<float>(slack * (double{object.radius} + double{object.grain} * 0x1p-10) + moved);
}

} // namespace

scene::Compiled with_half_boxes(const scene::Compiled& compiled)
{
    scene::Compiled out = compiled;
    std::vector<HalfNode> nodes;
    for (const LayoutNode& node : items_of<LayoutNode>(compiled.buffers, BUFFER_NODES)) {
        HalfNode& half = nodes.emplace_back();
        for (std::size_t k = 0; k < 6; ++k)
            for (std::size_t i = 0; i < 8; ++i)
                half.bounds[k][i] = half_bits(node.bounds[k][i], k < 3 ? Rounding::down : Rounding::up);
        std::memcpy(half.child, node.child, sizeof half.child);
    }
    out.buffers.bytes[BUFFER_NODES] = scene::Bytes(std::move(nodes));
    return out;
}

scene::Compiled with_half_coordinates(const scene::Compiled& compiled)
{
    scene::Compiled out = compiled;
    scene::Buffers& buffers = out.buffers;
    change<LayoutPlane>(buffers, BUFFER_PLANES, [](LayoutPlane& p) {
        to_halves(p.n);
        p.h = to_half(p.h);
    });
    change<LayoutPlaneBlock>(buffers, BUFFER_BLOCKS, [](LayoutPlaneBlock& b) {
        for (auto& n : b.n) to_halves(n);
        to_halves(b.h);
    });
    change<LayoutSphere>(buffers, BUFFER_SPHERES, [](LayoutSphere& s) {
        to_halves(s.c);
        s.r = to_half(s.r);
    });
    change<LayoutQuadric>(buffers, BUFFER_QUADRICS, [](LayoutQuadric& q) {
        to_halves(q.c);
        to_halves(q.m);
        q.g = to_half(q.g);
        q.w = to_half(q.w);
    });
    change<LayoutTorus>(buffers, BUFFER_TORI, [](LayoutTorus& t) {
        to_halves(t.c);
        to_halves(t.axis);
        t.major = to_half(t.major);
        t.minor = to_half(t.minor);
    });
    change<LayoutObject>(buffers, BUFFER_OBJECTS, move_center);
    return out;
}

scene::Compiled with_half_colors(const scene::Compiled& compiled)
{
    scene::Compiled out = compiled;
    change<LayoutLight>(out.buffers, BUFFER_LIGHTS, [](LayoutLight& l) { to_halves(l.color); });
    change<LayoutOptics>(out.buffers, BUFFER_OPTICS, [](LayoutOptics& o) { to_halves(o.extinction); });
    change<LayoutFrame>(out.buffers, BUFFER_FRAME, [](LayoutFrame& f) {
        to_halves(f.sky_low);
        to_halves(f.sky_middle);
        to_halves(f.sky_high);
    });
    return out;
}

std::size_t coordinate_bytes(const scene::Buffers& buffers)
{
    const auto count = [&](LayoutBuffer which, std::size_t item) { return buffers.bytes[which].size() / item; };
    constexpr std::size_t plane = 4, block = std::size_t{4} * PLANE_BLOCK, sphere = 4, quadric = 14, torus = 8,
                          object = 3; // floats
    return sizeof(float) *
           (plane * count(BUFFER_PLANES, sizeof(LayoutPlane)) + block * count(BUFFER_BLOCKS, sizeof(LayoutPlaneBlock)) +
            sphere * count(BUFFER_SPHERES, sizeof(LayoutSphere)) +
            quadric * count(BUFFER_QUADRICS, sizeof(LayoutQuadric)) + torus * count(BUFFER_TORI, sizeof(LayoutTorus)) +
            object * count(BUFFER_OBJECTS, sizeof(LayoutObject)));
}

} // namespace clucida::bench
