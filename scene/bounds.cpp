#include "scene/bounds.h"

#include <algorithm>

namespace clucida::scene {
namespace {

constexpr std::size_t most_planes = 64; ///< vertices of larger polyhedra are not enumerated

struct Bound {
    Box box;
    BoundingSphere sphere;
};

bool is_finite(const Box& b)
{
    return length(b.low) < unbounded && length(b.high) < unbounded;
}

Box common(const Box& a, const Box& b)
{
    return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
            {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
}

bool is_empty(const Box& b)
{
    return b.low.x > b.high.x || b.low.y > b.high.y || b.low.z > b.high.z;
}

Box hull(const Box& a, const Box& b)
{
    if (is_empty(a)) return b;
    if (is_empty(b)) return a;
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

Box around(Vec3 c, Vec3 half)
{
    return {c - half, c + half};
}

BoundingSphere sphere_of(const Box& box)
{
    if (!is_finite(box)) return {};
    const Vec3 half = (box.high - box.low) * 0.5;
    return {box.low + half, half.x < 0 || half.y < 0 || half.z < 0 ? 0 : length(half)};
}

const BoundingSphere& smaller(const BoundingSphere& a, const BoundingSphere& b)
{
    return a.radius <= b.radius ? a : b;
}

using Planes = std::vector<HalfSpace>;

bool inside_all(const Planes& planes, Vec3 p, double slack)
{
    return std::ranges::all_of(planes, [&](const HalfSpace& s) { return dot(s.n, p) <= s.h + slack; });
}

/// Whether some direction never leaves the polyhedron: extreme ones run along two of its planes.
bool recedes(const Planes& planes)
{
    const auto endless = [&](Vec3 d) {
        return std::ranges::all_of(planes, [&](const HalfSpace& s) { return dot(s.n, d) <= 1e-12; });
    };
    bool spans = false;
    for (std::size_t i = 0; i < planes.size(); i++) {
        for (std::size_t j = 0; j < i; j++) {
            const Vec3 d = cross(planes[i].n, planes[j].n);
            const double size = length(d);
            if (size < 1e-9) continue;
            if (endless(d * (1 / size)) || endless(d * (-1 / size))) return true;
            spans =
                spans || std::ranges::any_of(planes, [&](const HalfSpace& s) { return std::fabs(dot(s.n, d)) > 1e-9; });
        }
    }
    return !spans;
}

std::vector<Vec3> vertices(const Planes& planes)
{
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < planes.size(); i++) {
        for (std::size_t j = 0; j < i; j++) {
            const Vec3 direction = cross(planes[i].n, planes[j].n);
            for (std::size_t k = 0; k < j; k++) {
                const double volume = dot(direction, planes[k].n);
                if (std::fabs(volume) < 1e-9) continue;
                const Vec3 p = (cross(planes[j].n, planes[k].n) * planes[i].h +
                                cross(planes[k].n, planes[i].n) * planes[j].h + direction * planes[k].h) *
                               (1 / volume);
                if (inside_all(planes, p, 1e-9 * (1 + length(p)))) points.push_back(p);
            }
        }
    }
    return points;
}

Bound polyhedron_bound(const Planes& planes)
{
    Bound bound;
    if (planes.size() < 4 || planes.size() > most_planes || recedes(planes)) return bound;
    const std::vector<Vec3> points = vertices(planes);
    if (points.empty()) return {around({}, {-1, -1, -1}), {{}, 0}};
    bound.box = {points[0], points[0]};
    for (const Vec3& p : points) bound.box = hull(bound.box, {p, p});
    bound.sphere.center = (bound.box.low + bound.box.high) * 0.5;
    bound.sphere.radius = 0;
    for (const Vec3& p : points) bound.sphere.radius = std::max(bound.sphere.radius, length(p - bound.sphere.center));
    return bound;
}

/// How far up its axis a solid of revolution reaches below a plane: the greatest z with
/// up z - across radius(z) <= height, or infinity.
double reach(const Quadric::Revolution& r, double up, double across, double height)
{
    if (r.focus > 0) {
        if (!(up > 1e-12)) return unbounded;
        const double b = across * 2 * std::sqrt(r.focus);
        const double s = (b + std::sqrt(std::max(0.0, b * b + 4 * up * height))) / (2 * up);
        return s * s;
    }
    const double slope = up - across * r.slope;
    if (!(slope > 1e-12)) return unbounded;
    return std::max(0.0, height + across * r.r0) / slope;
}

/// The part of a solid of revolution that planes cut out, by its extent along its axis.
Box revolution_bound(const Quadric& q, const Planes& planes)
{
    const Quadric::Revolution& r = *q.revolution;
    double high = unbounded, low = r.focus > 0 ? 0 : -unbounded;
    for (const HalfSpace& plane : planes) {
        const double up = dot(plane.n, r.axis);
        const double across = length(plane.n - r.axis * up);
        const double height = plane.h - dot(plane.n, q.c);
        if (up > 0)
            high = std::min(high, reach(r, up, across, height));
        else if (r.focus == 0)
            low = std::max(low, -reach(r, -up, across, height));
    }
    if (!(high < unbounded) || !(low > -unbounded)) return {};
    const double far = std::max(std::fabs(low), std::fabs(high));
    const double radius = r.focus > 0 ? 2 * std::sqrt(r.focus * far) : r.r0 + r.slope * far;
    const Vec3 middle = q.c + r.axis * ((low + high) / 2);
    const auto half = [&](double a) {
        return std::fabs(a) * std::max(0.0, high - low) / 2 + radius * std::sqrt(std::max(0.0, 1 - a * a));
    };
    return around(middle, {half(r.axis.x), half(r.axis.y), half(r.axis.z)});
}

bool same_axis(Vec3 a, Vec3 b)
{
    return length(cross(a, b)) <= 1e-12;
}

/// A paraboloid less another, that opens the same way, within a cylinder; the axes of all three are parallel. Outside
/// of the other z is at most r^2 / (4 focus).
Box dish_bound(const Quadric& dish, const Quadric& hole, const Quadric& tube)
{
    const Quadric::Revolution &r = *dish.revolution, &h = *hole.revolution, &t = *tube.revolution;
    const bool is_tube = t.focus == 0 && t.slope == 0;
    if (!(r.focus > 0) || !(h.focus > 0) || !is_tube || !same_axis(r.axis, t.axis) || !same_axis(r.axis, h.axis) ||
        dot(r.axis, h.axis) < 0)
        return {};
    const double from_hole = length(cross(tube.c - hole.c, r.axis)) + t.r0;
    const double height = dot(hole.c - dish.c, r.axis) + from_hole * from_hole / (4 * h.focus);
    if (height < 0) return around({}, {-1, -1, -1});
    const Vec3 middle = tube.c + r.axis * (dot(dish.c - tube.c, r.axis) + height / 2);
    const auto half = [&](double a) { return std::fabs(a) * height / 2 + t.r0 * std::sqrt(std::max(0.0, 1 - a * a)); };
    return around(middle, {half(r.axis.x), half(r.axis.y), half(r.axis.z)});
}

Bound ellipsoid_bound(const Quadric& q)
{
    if (q.s != Vec3{1, 1, 1} || q.g != 0) return {};
    const Mat3 m = inverse(q.m);
    const Vec3 half{length(m.rows[0]), length(m.rows[1]), length(m.rows[2])};
    return {around(q.c, half), {}};
}

Bound ring_bound(const Ring& ring)
{
    const auto half = [&](double a) { return ring.major * std::sqrt(std::max(0.0, 1 - a * a)) + ring.minor; };
    return {around(ring.c, {half(ring.axis.x), half(ring.axis.y), half(ring.axis.z)}),
            {ring.c, ring.major + ring.minor}};
}

void cut(Bound& bound, const Bound& by)
{
    bound.box = common(bound.box, by.box);
    bound.sphere = smaller(bound.sphere, by.sphere);
}

std::vector<const Quadric*> solids_of_revolution(const std::vector<const Group*>& groups)
{
    std::vector<const Quadric*> found;
    for (const Group* group : groups)
        for (const Member& member : group->members)
            if (const auto* q = std::get_if<Quadric>(&member); q && q->revolution) found.push_back(q);
    return found;
}

/// Of an intersection of groups, less others: what each member allows, quadrics cut by all the planes.
Bound intersection_bound(const std::vector<const Group*>& groups, const std::vector<const Group*>& holes)
{
    Planes planes;
    for (const Group* group : groups)
        for (const Member& member : group->members)
            if (const auto* plane = std::get_if<HalfSpace>(&member)) planes.push_back(*plane);
    const std::vector<const Quadric*> revolved = solids_of_revolution(groups);
    Bound bound = polyhedron_bound(planes);
    for (const Quadric* hole : solids_of_revolution(holes))
        for (const Quadric* dish : revolved)
            for (const Quadric* tube : revolved) cut(bound, {dish_bound(*dish, *hole, *tube), {}});
    for (const Group* group : groups) {
        for (const Member& member : group->members) {
            if (const auto* ball = std::get_if<Ball>(&member)) {
                cut(bound, {around(ball->c, {ball->r, ball->r, ball->r}), {ball->c, ball->r}});
            } else if (const auto* q = std::get_if<Quadric>(&member)) {
                cut(bound, ellipsoid_bound(*q));
                if (q->revolution) cut(bound, {revolution_bound(*q, planes), {}});
            } else if (const auto* ring = std::get_if<Ring>(&member)) {
                cut(bound, ring_bound(*ring));
            }
        }
    }
    return bound;
}

Bound bound_of(const Form& form)
{
    if (form.kind == Form::Kind::any) {
        Bound bound = bound_of(form.parts[0]);
        for (std::size_t i = 1; i < form.parts.size(); i++) {
            const Bound part = bound_of(form.parts[i]);
            bound.box = hull(bound.box, part.box);
            // Parts of one torus share their sphere.
            if (part.sphere.center != bound.sphere.center || part.sphere.radius != bound.sphere.radius)
                bound.sphere = {};
        }
        return bound;
    }
    std::vector<const Group*> groups, holes;
    Bound bound;
    const auto add = [&](const Group& group) {
        if (!group.inverse)
            groups.push_back(&group);
        else if (group.members.size() == 1)
            holes.push_back(&group);
    };
    if (form.kind == Form::Kind::group) add(form.group);
    for (const Form& part : form.parts) {
        if (part.kind == Form::Kind::group)
            add(part.group);
        else
            cut(bound, bound_of(part));
    }
    cut(bound, intersection_bound(groups, holes));
    return bound;
}

} // namespace

Bounds bounds_of(const Form& form)
{
    const Bound bound = bound_of(form);
    const BoundingSphere sphere = smaller(bound.sphere, sphere_of(bound.box));
    if (!(sphere.radius < unbounded)) return {sphere, bound.box};
    return {sphere, common(bound.box, around(sphere.center, {sphere.radius, sphere.radius, sphere.radius}))};
}

} // namespace clucida::scene
