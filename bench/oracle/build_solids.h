/// Solids of a scene become primitives in scene coordinates and a boolean tree.
#pragma once

#include "bench/oracle/world.h"

namespace clucida::oracle {

/// Disturbs lengths and coordinates; coordinates count from the observer's eye, where rounding is finest.
template <class Real>
struct Disturber {
    std::optional<Disturbance> by;
    Vec<Real> eye;
    std::uint64_t object = 0; ///< its number from 1, or 0

    Real operator()(const Real& x) const { return by ? Real(x * Real(disturbed_by(by, to_double(x), object))) : x; }
    Vec<Real> vector(const Vec<Real>& v) const { return {(*this)(v.x), (*this)(v.y), (*this)(v.z)}; }
    Mat<Real> matrix(const Mat<Real>& m) const { return {vector(m.x), vector(m.y), vector(m.z)}; }
    Vec<Real> point(const Vec<Real>& p) const { return by ? eye + vector(p - eye) : p; }
};

/// By degrees about an axis through the origin (Rodrigues). Quarter turns are exact.
template <class Real>
Mat<Real> turned(const Vec<Real>& about, double degrees)
{
    const Vec<Real> a = unit(about);
    const Real angle = Real(degrees) * pi<Real>() / Real(180);
    Real c = cos(angle), s = sin(angle);
    const double quarters = std::fmod(degrees / 90, 4);
    if (quarters == std::floor(quarters)) {
        const int q = (static_cast<int>(quarters) + 4) % 4;
        c = q == 0 ? 1 : q == 2 ? -1 : 0;
        s = q == 1 ? 1 : q == 3 ? -1 : 0;
    }
    const auto column = [&](const Vec<Real>& v) { return v * c + cross(a, v) * s + a * (dot(a, v) * (Real(1) - c)); };
    return transposed(Mat<Real>{column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})});
}

template <class Real>
Affine<Real> affine_of(const scene::Move& move)
{
    return {Mat<Real>{}, vec<Real>(move.by)};
}
template <class Real>
Affine<Real> affine_of(const scene::Rotate& rotate)
{
    return {turned(vec<Real>(rotate.axis), rotate.degrees), {}};
}
template <class Real>
Affine<Real> affine_of(const scene::Scale& scale)
{
    const Vec<Real> by = vec<Real>(scale.by);
    return {{{by.x, Real(0), Real(0)}, {Real(0), by.y, Real(0)}, {Real(0), Real(0), by.z}}, {}};
}

/// Builds one object's solid. place maps the coordinates of the solid at hand to the scene's.
template <class Real>
class SolidBuilder {
public:
    SolidBuilder(const Disturber<Real>& disturber, Object<Real>& object) : disturb(disturber), out(object) {}

    void build(const scene::Solid& solid)
    {
        out.tree.root = add(solid, {});
        for (const Primitive<Real>& p : out.primitives) out.rough.push_back(rough_of(p));
        out.box = bounds_of(out.tree, enclosures);
        if (disturb.by) widen(out.box);
    }

private:
    using Place = Affine<Real>;
    using Kind = Tree::Kind;

    /// Where rays are disturbed they meet the solid a little beside its place, too.
    void widen(Box& box) const
    {
        const double far = size_of(disturb.eye);
        for (std::size_t i = 0; i < 3; i++) {
            box.low[i] -= 64 * disturb.by->size * (std::fabs(box.low[i]) + far);
            box.high[i] += 64 * disturb.by->size * (std::fabs(box.high[i]) + far);
        }
    }

    std::uint32_t node(Kind kind, std::vector<std::uint32_t> of, std::uint32_t primitive = 0)
    {
        out.tree.nodes.push_back({kind, primitive, std::move(of)});
        return static_cast<std::uint32_t>(out.tree.nodes.size() - 1);
    }

    std::uint32_t add(const scene::Solid& solid, const Place& place)
    {
        return std::visit([&](const auto& s) { return add(s, place); }, solid.node);
    }

    std::uint32_t all(Kind kind, const std::vector<scene::SolidPtr>& solids, const Place& place)
    {
        std::vector<std::uint32_t> of;
        of.reserve(solids.size());
        for (const scene::SolidPtr& s : solids) of.push_back(add(*s, place));
        return node(kind, std::move(of));
    }
    std::uint32_t add(const scene::Intersection& s, const Place& place) { return all(Kind::all, s.of, place); }
    std::uint32_t add(const scene::Union& s, const Place& place) { return all(Kind::any, s.of, place); }
    std::uint32_t add(const scene::Complement& s, const Place& place)
    {
        const std::uint32_t of = add(*s.of, place);
        return node(Kind::complement, {of});
    }
    std::uint32_t add(const scene::Difference& s, const Place& place)
    {
        const std::uint32_t from = add(*s.from, place), take = add(*s.take, place);
        const std::uint32_t not_taken = node(Kind::complement, {take});
        return node(Kind::all, {from, not_taken});
    }
    std::uint32_t add(const scene::Transformed& s, const Place& place)
    {
        const Affine<Real> by = std::visit([](const auto& t) { return affine_of<Real>(t); }, s.by);
        return add(*s.of, Place{place.linear * by.linear, place.linear * by.offset + place.offset});
    }

    std::uint32_t add_primitive(Primitive<Real> p, Enclosure enclosure)
    {
        p.extent = size_of(p.c);
        out.primitives.push_back(std::move(p));
        enclosures.push_back(std::move(enclosure));
        return node(Kind::primitive, {}, static_cast<std::uint32_t>(out.primitives.size() - 1));
    }

    /// Behind the plane dot(n, p - at) = 0 of the solid's own coordinates. Normals transform by the inverse' transpose.
    std::uint32_t add_plane(const Vec<Real>& at, const Vec<Real>& n, const Place& place)
    {
        Primitive<Real> p;
        const Vec<Real> across = unit(transposed(inverse(place.linear)) * n);
        const Real h = dot(across, place.linear * at + place.offset - disturb.eye);
        p.n = disturb.vector(across);
        p.c = disturb.eye + across * disturb(h);
        const Vec<double> out_of = converted<double>(p.n);
        return add_primitive(p, {{out_of, dot(out_of, converted<double>(p.c))}});
    }

    /// A half-space dot(n, X) <= h of a primitive's frame, X = m (p - c), in scene coordinates.
    static HalfSpace half_space(const Vec<double>& n, double h, const Mat<double>& m, const Vec<double>& c)
    {
        const Vec<double> across = transposed(m) * n;
        const double size = length(across);
        return {across * (1 / size), (h + dot(across, c)) / size};
    }

    /// s1 X.x^2 + s2 X.y^2 + s3 X.z^2 + 2 g X.z + w < 0 with X = m (p - at), in the solid's own coordinates.
    /// within lists half-spaces of that frame that hold the solid.
    std::uint32_t add_quadric(const Vec<Real>& at, const Mat<Real>& frame, const std::array<int, 3>& s, int g, int w,
                              const Enclosure& within, const Place& place)
    {
        Vec<Real> c = place.linear * at + place.offset;
        Mat<Real> m = frame * inverse(place.linear);
        const bool cylinder = s[2] == 0 && g == 0;
        if (cylinder) { // any point of the axis will do: the same one for all cylinders about it
            const Vec<Real> axis = unit(cross(m.x, m.y));
            c = c - axis * dot(axis, c - disturb.eye);
        }
        c = disturb.point(c);
        m = disturb.matrix(m);
        const Mat<Real> scaled{m.x * Real(s[0]), m.y * Real(s[1]), m.z * Real(s[2])};
        Primitive<Real> p;
        p.shape = Shape::quadric;
        p.c = c;
        p.h = transposed(m) * scaled;
        p.n = m.z * Real(g);
        p.w = w;
        const Mat<double> rough{converted<double>(m.x), converted<double>(m.y), converted<double>(m.z)};
        Enclosure enclosure;
        for (const HalfSpace& e : within) enclosure.push_back(half_space(e.n, e.h, rough, converted<double>(c)));
        return add_primitive(p, std::move(enclosure));
    }

    static Mat<Real> stretched(const Mat<Real>& m, const Real& x, const Real& y, const Real& z)
    {
        return {m.x * x, m.y * y, m.z * z};
    }

    std::uint32_t add(const scene::Plane& s, const Place& place)
    {
        return add_plane(vec<Real>(s.point), vec<Real>(s.normal), place);
    }
    std::uint32_t add(const scene::Sphere& s, const Place& place)
    {
        const Real k = Real(1) / Real(s.radius);
        const Enclosure cube{{{1, 0, 0}, 1},  {{0, 1, 0}, 1},  {{0, 0, 1}, 1},
                             {{-1, 0, 0}, 1}, {{0, -1, 0}, 1}, {{0, 0, -1}, 1}};
        return add_quadric(vec<Real>(s.center), stretched(Mat<Real>{}, k, k, k), {1, 1, 1}, 0, -1, cube, place);
    }
    std::uint32_t add(const scene::Cylinder& s, const Place& place)
    {
        const Vec<Real> axis = vec<Real>(s.axis);
        const Real k = Real(1) / length(axis);
        const Enclosure prism{{{1, 0, 0}, 1}, {{0, 1, 0}, 1}, {{-1, 0, 0}, 1}, {{0, -1, 0}, 1}};
        return add_quadric(vec<Real>(s.point), stretched(axis_frame(axis), k, k, k), {1, 1, 0}, 0, -1, prism, place);
    }
    std::uint32_t add(const scene::Cone& s, const Place& place)
    {
        const Vec<Real> axis = vec<Real>(s.axis);
        const Mat<Real> m = stretched(axis_frame(axis), Real(1), Real(1), Real(Real(1) / length(axis)));
        return add_quadric(vec<Real>(s.apex), m, {1, 1, -1}, 0, 0, {}, place);
    }
    /// x^2 + y^2 < 4 f z; with X = (x, y, z) / 2f: X.x^2 + X.y^2 - 2 X.z < 0, which lies behind X.z = |X.x| - 1/2.
    std::uint32_t add(const scene::Paraboloid& s, const Place& place)
    {
        const Vec<Real> focus = vec<Real>(s.focus);
        const Real k = Real(1) / (Real(2) * length(focus));
        const Enclosure bowl{
            {{0, 0, -1}, 0}, {{1, 0, -1}, 0.5}, {{-1, 0, -1}, 0.5}, {{0, 1, -1}, 0.5}, {{0, -1, -1}, 0.5}};
        return add_quadric(vec<Real>(s.vertex), stretched(axis_frame(focus), k, k, k), {1, 1, 0}, -1, 0, bowl, place);
    }
    std::uint32_t add(const scene::Hyperboloid& s, const Place& place)
    {
        const Vec<Real> axis = vec<Real>(s.axis);
        const Real k = Real(1) / Real(s.waist);
        const Mat<Real> m = stretched(axis_frame(axis), k, k, Real(Real(1) / length(axis)));
        return add_quadric(vec<Real>(s.center), m, {1, 1, -1}, 0, -1, {}, place);
    }
    /// z < a (x^2 - y^2); with X = (2a x, 2a y, 2a z): 2 X.z < X.x^2 - X.y^2.
    std::uint32_t add(const scene::Saddle& s, const Place& place)
    {
        const Vec<Real> axis = vec<Real>(s.axis);
        const Real k = Real(2) * length(axis);
        const Mat<Real> m = stretched(axis_frame(axis, vec<Real>(s.x)), k, k, k);
        return add_quadric(vec<Real>(s.center), m, {-1, 1, 0}, 1, 0, {}, place);
    }
    /// Six planes, those of x first, the lower ones first; fewer where a size is 0.
    std::uint32_t add(const scene::Cuboid& s, const Place& place)
    {
        const Mat<Real> frame = axis_frame(vec<Real>(s.z), vec<Real>(s.x));
        const Vec<Real> center = vec<Real>(s.center);
        std::vector<std::uint32_t> of;
        const auto slab = [&](const Vec<Real>& axis, double size) {
            if (size == 0) return;
            const Vec<Real> half = axis * (Real(size) / Real(2));
            of.push_back(add_plane(center - half, -axis, place));
            of.push_back(add_plane(center + half, axis, place));
        };
        slab(frame.x, s.size.x);
        slab(frame.y, s.size.y);
        slab(frame.z, s.size.z);
        return node(Kind::all, std::move(of));
    }
    /// X = H r is the torus' own frame, its z axis that of the torus. Where every direction is scaled alike this is a
    /// torus again, of major and minor in own units.
    std::uint32_t add(const scene::Torus& s, const Place& place)
    {
        Primitive<Real> p;
        p.shape = Shape::torus;
        p.c = disturb.point(place.linear * vec<Real>(s.center) + place.offset);
        p.h = disturb.matrix(axis_frame(vec<Real>(s.axis)) * inverse(place.linear));
        p.major = disturb(Real(s.major));
        p.minor = disturb(Real(s.minor));
        const Mat<double> rough{converted<double>(p.h.x), converted<double>(p.h.y), converted<double>(p.h.z)};
        const Vec<double> c = converted<double>(p.c);
        Enclosure enclosure;
        for (const double sign : {-1.0, 1.0}) {
            enclosure.push_back(half_space({sign, 0, 0}, s.major + s.minor, rough, c));
            enclosure.push_back(half_space({0, sign, 0}, s.major + s.minor, rough, c));
            enclosure.push_back(half_space({0, 0, sign}, s.minor, rough, c));
        }
        return add_primitive(p, std::move(enclosure));
    }

    /// p S p + 2 l p + k < 0 in own coordinates: p = back (scene - offset). It has no enclosure: the general case is
    /// unbounded, and which cases are not would take its axes to tell.
    std::uint32_t add(const scene::FreeQuadric& s, const Place& place)
    {
        const auto& q = s.q;
        const Real half = Real(1) / Real(2);
        const Real xy = Real(q[3]) * half, xz = Real(q[4]) * half, yz = Real(q[5]) * half;
        const Mat<Real> second{{Real(q[0]), xy, xz}, {xy, Real(q[1]), yz}, {xz, yz, Real(q[2])}};
        const Vec<Real> first{Real(q[6]) * half, Real(q[7]) * half, Real(q[8]) * half};
        const Mat<Real> back = inverse(place.linear);
        Primitive<Real> p;
        p.shape = Shape::quadric;
        p.c = disturb.point(place.offset);
        p.h = transposed(back) * (disturb.matrix(second) * back);
        p.n = transposed(back) * disturb.vector(first);
        p.w = disturb(Real(q[9]));
        return add_primitive(p, {});
    }

    const Disturber<Real>& disturb;
    Object<Real>& out;
    std::vector<Enclosure> enclosures;
};

} // namespace clucida::oracle
