/// Boolean trees taken apart; and the same solid elsewhere: scaled, mirrored or moved by rewriting its numbers.
#pragma once

#include "native_scene.h"

namespace clucida::test {

/// What a boolean joins; nothing for a primitive or an ellipsoid.
inline std::vector<SolidPtr> parts_of(const SolidPtr& s)
{
    if (const auto* n = std::get_if<scene::Complement>(&s->node)) return {n->of};
    if (const auto* n = std::get_if<scene::Intersection>(&s->node)) return n->of;
    if (const auto* n = std::get_if<scene::Union>(&s->node)) return n->of;
    if (const auto* n = std::get_if<scene::Difference>(&s->node)) return {n->from, n->take};
    return {};
}

/// How a map acts on points, on vectors that are lengths, on directions alone, on axes of rotation; and on lengths.
struct Similarity {
    double length = 1;
    bool mirror = false; ///< x -> -x
    Vec3 point(Vec3 p) const { return {(mirror ? -p.x : p.x) * length, p.y * length, p.z * length}; }
    Vec3 direction(Vec3 d) const { return {mirror ? -d.x : d.x, d.y, d.z}; }
    Vec3 turning(Vec3 axis) const { return mirror ? Vec3{axis.x, -axis.y, -axis.z} : axis; }
};

SolidPtr mapped(const SolidPtr& solid, const Similarity& by);

struct Mapper {
    Similarity by;

    SolidPtr operator()(const scene::Plane& s) const
    {
        return solid(scene::Plane{by.point(s.point), by.direction(s.normal)});
    }
    SolidPtr operator()(const scene::Sphere& s) const
    {
        return solid(scene::Sphere{by.point(s.center), s.radius * by.length});
    }
    SolidPtr operator()(const scene::Cylinder& s) const
    {
        return solid(scene::Cylinder{by.point(s.point), by.point(s.axis)});
    }
    SolidPtr operator()(const scene::Cone& s) const // a slope is no length
    {
        return solid(scene::Cone{by.point(s.apex), by.direction(s.axis)});
    }
    SolidPtr operator()(const scene::Paraboloid& s) const
    {
        return solid(scene::Paraboloid{by.point(s.vertex), by.point(s.focus)});
    }
    SolidPtr operator()(const scene::Hyperboloid& s) const
    {
        return solid(scene::Hyperboloid{by.point(s.center), by.point(s.axis), s.waist * by.length});
    }
    SolidPtr operator()(const scene::Saddle& s) const // a curvature
    {
        return solid(scene::Saddle{by.point(s.center), by.direction(s.axis) * (1 / by.length), by.direction(s.x)});
    }
    SolidPtr operator()(const scene::Cuboid& s) const
    {
        return solid(scene::Cuboid{by.point(s.center), by.direction(s.z), by.direction(s.x), s.size * by.length});
    }
    SolidPtr operator()(const scene::Torus& s) const
    {
        return solid(scene::Torus{by.point(s.center), by.direction(s.axis), s.major * by.length, s.minor * by.length});
    }
    SolidPtr operator()(const scene::FreeQuadric& s) const
    {
        scene::FreeQuadric image = s;
        if (by.mirror)
            for (const std::size_t i : {3U, 4U, 6U}) image.q[i] = -image.q[i]; // x y, x z, x
        for (std::size_t i = 6; i < 9; i++) image.q[i] *= by.length;
        image.q[9] *= by.length * by.length;
        return solid(image);
    }
    SolidPtr operator()(const scene::Complement& s) const { return complement(mapped(s.of, by)); }
    SolidPtr operator()(const scene::Intersection& s) const { return solid(scene::Intersection{all(s.of)}); }
    SolidPtr operator()(const scene::Union& s) const { return solid(scene::Union{all(s.of)}); }
    SolidPtr operator()(const scene::Difference& s) const
    {
        return solid(scene::Difference{mapped(s.from, by), mapped(s.take, by)});
    }
    /// Of ellipsoids: a move of a rotation of a stretched unit sphere.
    SolidPtr operator()(const scene::Transformed& s) const
    {
        if (const auto* move = std::get_if<scene::Move>(&s.by))
            return solid(scene::Transformed{scene::Move{by.point(move->by)}, mapped(s.of, by)});
        if (const auto* turn = std::get_if<scene::Rotate>(&s.by))
            return solid(scene::Transformed{scene::Rotate{by.turning(turn->axis), turn->degrees}, mapped(s.of, by)});
        return solid(scene::Transformed{scene::Scale{std::get<scene::Scale>(s.by).by * by.length}, s.of});
    }

private:
    std::vector<SolidPtr> all(const std::vector<SolidPtr>& of) const
    {
        std::vector<SolidPtr> parts;
        for (const SolidPtr& s : of) parts.push_back(mapped(s, by));
        return parts;
    }
};

inline SolidPtr mapped(const SolidPtr& solid, const Similarity& by)
{
    return std::visit(Mapper{by}, solid->node);
}

inline SolidPtr moved(const SolidPtr& of, Vec3 by)
{
    return solid(scene::Transformed{scene::Move{by}, of});
}

} // namespace clucida::test
