#include "scene/normal_form.h"

#include "scene/error.h"
#include "scene/free_quadric.h"

#include <algorithm>
#include <unordered_map>

namespace clucida::scene {
namespace {

/// A frame with z along the axis and x as near to the wish as that allows; rows are x, y, z.
Mat3 frame(Vec3 z, std::optional<Vec3> wish = std::nullopt)
{
    z = unit(z);
    const Vec3 far = std::fabs(z.x) <= std::fabs(z.y) && std::fabs(z.x) <= std::fabs(z.z) ? Vec3{1, 0, 0}
                     : std::fabs(z.y) <= std::fabs(z.z)                                   ? Vec3{0, 1, 0}
                                                                                          : Vec3{0, 0, 1};
    Vec3 x = wish.value_or(far);
    x = unit(x - z * dot(x, z));
    return {{x, cross(z, x), z}};
}

Mat3 with_rows_scaled(Mat3 m, Vec3 by)
{
    m.rows = {m.rows[0] * by.x, m.rows[1] * by.y, m.rows[2] * by.z};
    return m;
}

/// A quadric of this frame under the map; revolution survives only where the map keeps shapes.
Member placed(Quadric q, const Affine& map)
{
    q.c = map * q.c;
    q.m = q.m * inverse(map.linear);
    if (q.revolution) {
        const double scale = uniform_scale(map.linear);
        if (scale > 0) {
            q.revolution->axis = unit(map.linear * q.revolution->axis);
            q.revolution->r0 *= scale;
            q.revolution->focus *= scale;
        } else {
            q.revolution.reset();
        }
    }
    return q;
}

HalfSpace half_space(Vec3 point, Vec3 normal, const Affine& map)
{
    const Vec3 n = unit(cofactor(map.linear) * normal * (determinant(map.linear) < 0 ? -1 : 1));
    return {n, dot(n, map * point)};
}

Group group_of(const Member& member)
{
    return {{member}, false};
}

Group group(const Plane& s, const Affine& map)
{
    return group_of(half_space(s.point, s.normal, map));
}

Group group(const Sphere& s, const Affine& map)
{
    const double scale = uniform_scale(map.linear);
    if (scale > 0) return group_of(Ball{map * s.center, s.radius * scale});
    const double k = 1 / s.radius;
    return group_of(placed({s.center, with_rows_scaled({}, {k, k, k}), {1, 1, 1}, 0, -1, true, {}}, map));
}

Group group(const Cylinder& s, const Affine& map)
{
    const double r = length(s.axis);
    const Mat3 m = with_rows_scaled(frame(s.axis), {1 / r, 1 / r, 1 / r});
    return group_of(placed({s.point, m, {1, 1, 0}, 0, -1, true, {{unit(s.axis), r, 0, 0}}}, map));
}

Group group(const Cone& s, const Affine& map)
{
    const double h = length(s.axis);
    const Mat3 m = with_rows_scaled(frame(s.axis), {1, 1, 1 / h});
    return group_of(placed({s.apex, m, {1, 1, -1}, 0, 0, false, {{unit(s.axis), 0, 1 / h, 0}}}, map));
}

Group group(const Paraboloid& s, const Affine& map)
{
    const double f = length(s.focus), k = 1 / (2 * f);
    const Mat3 m = with_rows_scaled(frame(s.focus), {k, k, k});
    return group_of(placed({s.vertex, m, {1, 1, 0}, 1, 0, true, {{unit(s.focus), 0, 0, f}}}, map));
}

Group group(const Hyperboloid& s, const Affine& map)
{
    const double h = length(s.axis), k = 1 / s.waist;
    const Mat3 m = with_rows_scaled(frame(s.axis), {k, k, 1 / h});
    return group_of(placed({s.center, m, {1, 1, -1}, 0, -1, false, {{unit(s.axis), s.waist, s.waist / h, 0}}}, map));
}

/// z < a (x^2 - y^2): with X = 2 a x it is -X0^2 + X1^2 + 2 X2 < 0.
Group group(const Saddle& s, const Affine& map)
{
    const double k = 2 * length(s.axis);
    const Mat3 m = with_rows_scaled(frame(s.axis, s.x), {k, k, k});
    return group_of(placed({s.center, m, {-1, 1, 0}, -1, 0, false, {}}, map));
}

Group group(const Cuboid& s, const Affine& map)
{
    const Mat3 f = frame(s.z, s.x);
    Group planes;
    for (int axis = 0; axis < 3; axis++) {
        const double half = component(s.size, axis) / 2;
        if (half == 0) continue;
        const Vec3 n = f.rows[axis];
        planes.members.emplace_back(half_space(s.center + n * half, n, map));
        planes.members.emplace_back(half_space(s.center - n * half, -n, map));
    }
    return planes;
}

HalfSpace placed(const HalfSpace& plane, const Affine& map)
{
    return half_space(plane.n * plane.h, plane.n, map);
}

bool is_convex(const Member& member)
{
    if (std::holds_alternative<Ring>(member)) return false;
    const auto* q = std::get_if<Quadric>(&member);
    return q == nullptr || q->convex;
}

bool is_convex(const Form& form)
{
    return form.kind == Form::Kind::group && !form.group.inverse &&
           std::ranges::all_of(form.group.members, [](const Member& m) { return is_convex(m); });
}

bool is_convex_complement(const Form& form)
{
    return form.kind == Form::Kind::group && form.group.inverse &&
           std::ranges::all_of(form.group.members, [](const Member& m) { return is_convex(m); });
}

/// A half-space's complement is a half-space.
Group complemented(Group g)
{
    if (g.members.size() == 1 && std::holds_alternative<HalfSpace>(g.members[0])) {
        auto& plane = std::get<HalfSpace>(g.members[0]);
        plane = {-plane.n, -plane.h};
        return g;
    }
    g.inverse = !g.inverse;
    return g;
}

void add_part(std::vector<Form>& parts, Form part)
{
    if (std::ranges::find(parts, part) == parts.end()) parts.push_back(std::move(part));
}

/// Joins parts by "all" or "any": nested joins of the same kind are opened, convex groups of an "all" (complements of
/// convex groups of an "any") become one, twins are dropped.
Form joined(Form::Kind kind, std::vector<Form> parts)
{
    const auto mergeable = [kind](const Form& f) {
        return kind == Form::Kind::all ? is_convex(f) : is_convex_complement(f);
    };
    std::vector<Form> flat;
    for (Form& part : parts) {
        if (part.kind == kind)
            for (Form& inner : part.parts) flat.push_back(std::move(inner));
        else
            flat.push_back(std::move(part));
    }
    Form merged{Form::Kind::group, {{}, kind == Form::Kind::any}, {}};
    // Two complements of half-spaces are half-spaces; in a union they stay apart, for a union of them is not convex.
    std::vector<Form> rest;
    for (Form& part : flat) {
        if (!mergeable(part)) {
            add_part(rest, std::move(part));
            continue;
        }
        for (const Member& member : part.group.members)
            if (std::ranges::find(merged.group.members, member) == merged.group.members.end())
                merged.group.members.push_back(member);
    }
    if (!merged.group.members.empty()) rest.insert(rest.begin(), std::move(merged));
    if (rest.size() == 1) return std::move(rest[0]);
    const Form::Kind other = kind == Form::Kind::all ? Form::Kind::any : Form::Kind::all;
    if (rest.size() == 2 && mergeable(rest[0]) && rest[1].kind == other &&
        std::ranges::all_of(rest[1].parts, mergeable)) {
        // Flat forms are met faster: (a or b) and c is (a and c) or (b and c).
        for (Form& part : rest[1].parts) part = joined(kind, {rest[0], std::move(part)});
        return joined(other, std::move(rest[1].parts));
    }
    return {kind, {}, std::move(rest)};
}

struct Builder {
    Form build(const Solid& solid, const Affine& map, bool complement)
    {
        return std::visit([&](const auto& node) { return form(node, solid, map, complement); }, solid.node);
    }

    template <typename Primitive>
    Form form(const Primitive& primitive, const Solid& solid, const Affine& map, bool complement)
    {
        Group g = group(primitive, map);
        if (g.members.empty()) throw Error(solid.at, "this solid has no boundary; expected a part of space");
        return {Form::Kind::group, complement ? complemented(std::move(g)) : std::move(g), {}};
    }

    Form form(const FreeQuadric& node, const Solid& solid, const Affine& map, bool complement)
    {
        const auto found = canonical(node);
        if (!found) throw Error(solid.at, "this quadric has no boundary; expected factors of either sign");
        if (const auto* pair = std::get_if<PlanePair>(&*found)) return form(*pair, map, complement);
        const auto* plane = std::get_if<HalfSpace>(&*found);
        Group g = group_of(plane != nullptr ? placed(*plane, map) : placed(std::get<Quadric>(*found), map));
        return {Form::Kind::group, complement ? complemented(std::move(g)) : std::move(g), {}};
    }

    Form form(const PlanePair& pair, const Affine& map, bool complement)
    {
        const HalfSpace a = placed(pair.a, map), b = placed(pair.b, map), not_a{-a.n, -a.h}, not_b{-b.n, -b.h};
        if (!pair.crossing) return {Form::Kind::group, {{a, b}, complement != pair.inverse}, {}};
        const Group first{{a, complement ? b : not_b}, false}, second{{not_a, complement ? not_b : b}, false};
        return {Form::Kind::any, {}, {{Form::Kind::group, first, {}}, {Form::Kind::group, second, {}}}};
    }

    /// A line may have two intervals in a torus: its first or its second.
    Form form(const Torus& torus, const Solid& solid, const Affine& map, bool complement)
    {
        const double scale = uniform_scale(map.linear);
        if (scale == 0)
            throw Error(skewed.line != 0 ? skewed : solid.at,
                        "this scale makes of a torus what is none; expected the same factor in every direction");
        Ring ring{map * torus.center, unit(map.linear * torus.axis), torus.major * scale, torus.minor * scale};
        Form parts{complement ? Form::Kind::all : Form::Kind::any, {}, {}};
        for (ring.part = 0; ring.part < 2; ring.part++)
            parts.parts.push_back({Form::Kind::group, {{ring}, complement}, {}});
        return parts;
    }

    Form form(const Complement& node, const Solid&, const Affine& map, bool complement)
    {
        return build(*node.of, map, !complement);
    }

    Form form(const Intersection& node, const Solid&, const Affine& map, bool complement)
    {
        return join(node.of, map, complement, complement ? Form::Kind::any : Form::Kind::all);
    }

    Form form(const Union& node, const Solid&, const Affine& map, bool complement)
    {
        return join(node.of, map, complement, complement ? Form::Kind::all : Form::Kind::any);
    }

    Form form(const Difference& node, const Solid&, const Affine& map, bool complement)
    {
        std::vector<Form> parts;
        parts.push_back(build(*node.from, map, complement));
        parts.push_back(build(*node.take, map, !complement));
        return joined(complement ? Form::Kind::any : Form::Kind::all, std::move(parts));
    }

    Form form(const Transformed& node, const Solid& solid, const Affine& map, bool complement)
    {
        const Affine inner = map * affine_of(node.by);
        const double volume = std::fabs(determinant(inner.linear));
        if (!(volume > 1e-30) || !(volume < 1e30))
            throw Error(solid.at, "this transform flattens or blows up the solid; expected factors nearer to 1");
        const Location before = skewed;
        if (uniform_scale(map.linear) > 0 && uniform_scale(inner.linear) == 0) skewed = solid.at;
        Form form = build(*node.of, inner, complement);
        skewed = before;
        return form;
    }

    Form join(const std::vector<SolidPtr>& of, const Affine& map, bool complement, Form::Kind kind)
    {
        std::vector<Form> parts;
        parts.reserve(of.size());
        for (const SolidPtr& part : of) parts.push_back(build(*part, map, complement));
        return joined(kind, std::move(parts));
    }

    Location skewed; ///< the transform that stopped lengths from scaling alike in every direction
};

using Memo = std::unordered_map<const Solid*, std::size_t>;

std::size_t count(const Solid& solid, std::size_t limit, Memo& memo);

std::size_t count_all(std::initializer_list<const Solid*> parts, std::size_t limit, Memo& memo)
{
    std::size_t sum = 0;
    for (const Solid* part : parts) sum = std::min(limit, sum + count(*part, limit, memo));
    return sum;
}

std::size_t count_node(const auto& node, std::size_t limit, Memo& memo)
{
    using Node = std::decay_t<decltype(node)>;
    if constexpr (std::is_same_v<Node, Complement> || std::is_same_v<Node, Transformed>) {
        return count_all({node.of.get()}, limit, memo);
    } else if constexpr (std::is_same_v<Node, Difference>) {
        return count_all({node.from.get(), node.take.get()}, limit, memo);
    } else if constexpr (std::is_same_v<Node, Intersection> || std::is_same_v<Node, Union>) {
        std::size_t sum = 0;
        for (const SolidPtr& part : node.of) sum = std::min(limit, sum + count(*part, limit, memo));
        return sum;
    } else if constexpr (std::is_same_v<Node, Cuboid>) {
        return 6;
    } else if constexpr (std::is_same_v<Node, Torus>) {
        return 2;
    } else if constexpr (std::is_same_v<Node, FreeQuadric>) {
        return 4; // if it is two planes that cross
    } else {
        return 1;
    }
}

std::size_t count(const Solid& solid, std::size_t limit, Memo& memo)
{
    const auto found = memo.find(&solid);
    if (found != memo.end()) return found->second;
    const std::size_t n = std::visit([&](const auto& node) { return count_node(node, limit, memo); }, solid.node);
    memo.emplace(&solid, n);
    return n;
}

/// How far beyond the boundary p lies, roughly a length; and whether that is surely more than margin.
double depth(const HalfSpace& plane, Vec3 p)
{
    return dot(plane.n, p) - plane.h;
}
double depth(const Ball& ball, Vec3 p)
{
    return length(p - ball.c) - ball.r;
}
double depth(const Ring& ring, Vec3 p)
{
    const Vec3 x = p - ring.c;
    const double z = dot(ring.axis, x);
    return std::hypot(length(x - ring.axis * z) - ring.major, z) - ring.minor;
}
double depth(const Quadric& q, Vec3 p)
{
    const Vec3 x = q.m * (p - q.c);
    const double value = q.s.x * x.x * x.x + q.s.y * x.y * x.y + q.s.z * x.z * x.z - 2 * q.g * x.z + q.w;
    // Distance is at least what value, slope and curvature allow: |value| <= |gradient| t + curvature t^2.
    const Vec3 gradient = transposed(q.m) * Vec3{2 * q.s.x * x.x, 2 * q.s.y * x.y, 2 * (q.s.z * x.z - q.g)};
    double curvature = 0;
    for (const Vec3& row : q.m.rows) curvature += dot(row, row);
    const double slope = length(gradient);
    const double t =
        2 * std::fabs(value) / (slope + std::sqrt(slope * slope + 4 * curvature * std::fabs(value)) + 1e-300);
    return std::copysign(t, value);
}

std::optional<bool> holds(const Group& group, Vec3 p, double margin)
{
    bool unsure = false;
    for (const Member& member : group.members) {
        const double d = std::visit([&](const auto& m) { return depth(m, p); }, member);
        if (d > margin) return group.inverse;
        unsure |= d > -margin;
    }
    if (unsure) return std::nullopt;
    return !group.inverse;
}

} // namespace

std::size_t expanded_members(const Solid& solid, std::size_t limit)
{
    Memo memo;
    return count(solid, limit, memo);
}

Form normal_form(const Solid& solid)
{
    return Builder{}.build(solid, {}, false);
}

std::optional<bool> holds(const Form& form, Vec3 p, double margin)
{
    if (form.kind == Form::Kind::group) return holds(form.group, p, margin);
    const bool decides = form.kind == Form::Kind::any;
    bool unsure = false;
    for (const Form& part : form.parts) {
        const std::optional<bool> inside = holds(part, p, margin);
        if (inside == decides) return decides;
        unsure |= !inside.has_value();
    }
    if (unsure) return std::nullopt;
    return !decides;
}

} // namespace clucida::scene
