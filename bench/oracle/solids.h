/// Primitive surfaces along a ray, and the boolean trees over them. Everything stands in scene coordinates.
#pragma once

#include "bench/oracle/polynomial.h"
#include "bench/oracle/vec.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace clucida::oracle {

template <class Real>
struct Ray {
    Vec<Real> o, d; ///< d is of length 1
};

enum class Shape : std::uint8_t { plane, quadric, torus };

/// A surface and the solid behind it, with r = p - c:
/// plane: dot(n, r) < 0; quadric: r H r + 2 n r + w < 0;
/// torus, with X = H r: (|X|^2 + major^2 - minor^2)^2 < 4 major^2 (X.x^2 + X.y^2).
template <class Real>
struct Primitive {
    Shape shape = Shape::plane;
    Vec<Real> c, n;
    Mat<Real> h;
    Real w = 0;
    Real major = 0, minor = 0;
    double extent = 0; ///< the size of c: how large the numbers are that its crossings come from
};

template <class Real>
Real value_at(const Primitive<Real>& s, const Vec<Real>& p)
{
    const Vec<Real> r = p - s.c;
    if (s.shape == Shape::plane) return dot(s.n, r);
    const Vec<Real> x = s.h * r;
    if (s.shape == Shape::quadric) return dot(r, x) + Real(2) * dot(s.n, r) + s.w;
    const Real sum = dot(x, x) + s.major * s.major - s.minor * s.minor;
    return sum * sum - Real(4) * s.major * s.major * (x.x * x.x + x.y * x.y);
}

/// Of any length, out of the solid.
template <class Real>
Vec<Real> gradient_at(const Primitive<Real>& s, const Vec<Real>& p)
{
    if (s.shape == Shape::plane) return s.n;
    const Vec<Real> r = p - s.c, x = s.h * r;
    if (s.shape == Shape::quadric) return x + s.n;
    const Real sum = dot(x, x) + s.major * s.major - s.minor * s.minor;
    const Real k = Real(2) * s.major * s.major;
    return transposed(s.h) * Vec<Real>{x.x * (sum - k), x.y * (sum - k), x.z * sum};
}

/// A primitive's function along a ray: q(o + t d) = a t^2 + 2 b t + c for plane and quadric. Where double arithmetic
/// shows beyond doubt that the line misses the surface it is settled on which side.
template <class Real>
struct Along {
    Real a = 0, b = 0, c = 0;
    bool settled = false, settled_inside = false;
    bool from_surface = false; ///< the ray starts on this surface: c is 0 by definition
};

/// What a quadric's primitive is in double, to discard it fast.
struct Rough {
    Vec<double> c, n;
    Mat<double> h;
    double w = 0, h_size = 0, n_size = 0;
};

template <class Real>
Rough rough_of(const Primitive<Real>& s)
{
    Rough r{converted<double>(s.c),
            converted<double>(s.n),
            {converted<double>(s.h.x), converted<double>(s.h.y), converted<double>(s.h.z)},
            to_double(s.w)};
    r.h_size = size_of(r.h.x) + size_of(r.h.y) + size_of(r.h.z);
    r.n_size = size_of(r.n);
    return r;
}

/// Whether the line surely misses the quadric; then inside says on which side it lies. The margin is ten thousand times
/// the rounding of these sums.
inline bool surely_missed(const Rough& s, const Ray<double>& ray, bool& inside)
{
    const Vec<double> r = ray.o - s.c, hd = s.h * ray.d;
    const double a = dot(ray.d, hd), b = dot(r, hd) + dot(s.n, ray.d);
    const double c = dot(r, s.h * r) + 2 * dot(s.n, r) + s.w;
    const double far = size_of(ray.o) + size_of(s.c);
    const double b_size = s.h_size * far + s.n_size, c_size = (s.h_size * far + 2 * s.n_size) * far + std::fabs(s.w);
    if (!(b * b - a * c < -1e-12 * (b_size * b_size + s.h_size * c_size))) return false;
    inside = a < 0;
    return true;
}

template <class Real>
Along<Real> along(const Primitive<Real>& s, const Rough& rough, const Ray<Real>& ray, const Ray<double>& rough_ray,
                  bool from_surface)
{
    Along<Real> q;
    q.from_surface = from_surface;
    if (s.shape == Shape::plane) {
        q.b = dot(s.n, ray.d) / Real(2);
        if (!from_surface) q.c = dot(s.n, ray.o - s.c);
    } else if (s.shape == Shape::quadric) {
        q.settled = !from_surface && surely_missed(rough, rough_ray, q.settled_inside);
        if (q.settled) return q;
        const Vec<Real> r = ray.o - s.c, hd = s.h * ray.d;
        q.a = dot(ray.d, hd);
        q.b = dot(r, hd) + dot(s.n, ray.d);
        if (!from_surface) q.c = dot(r, s.h * r) + Real(2) * dot(s.n, r) + s.w;
        // A ruling's or an axis' direction, up to rounding: no second crossing far out.
        if (std::fabs(to_double(q.a)) <= 64 * epsilon<Real>() * rough.h_size) q.a = 0;
    }
    return q;
}

template <class Real>
bool inside_at(const Primitive<Real>& s, const Along<Real>& q, const Ray<Real>& ray, const Real& t)
{
    if (q.settled) return q.settled_inside;
    if (s.shape == Shape::torus) return value_at(s, ray.o + ray.d * t) < 0;
    return (q.a * t + Real(2) * q.b) * t + q.c < 0;
}

/// The torus' function along the ray, in u = t - t0 with t0 the ray's nearest point to the centre, where the
/// coefficients are small. The root of a ray that starts on the surface is divided out.
template <class Real>
std::vector<Real> torus_crossings(const Primitive<Real>& s, const Ray<Real>& ray, bool from_surface)
{
    const Vec<Real> d = s.h * ray.d, start = s.h * (ray.o - s.c);
    const Real a = dot(d, d), t0 = -dot(start, d) / a;
    const Vec<Real> x = start + d * t0;
    const Real b = dot(x, d), rr = s.major * s.major, c = dot(x, x) + rr - s.minor * s.minor;
    const Real e = d.x * d.x + d.y * d.y, f = d.x * x.x + d.y * x.y, g = x.x * x.x + x.y * x.y;
    Polynomial<Real> p;
    p.c[4] = a * a;
    p.c[3] = Real(4) * a * b;
    p.c[2] = Real(4) * b * b + Real(2) * a * c - Real(4) * rr * e;
    p.c[1] = Real(4) * b * c - Real(8) * rr * f;
    p.c[0] = c * c - Real(4) * rr * g;
    if (from_surface) p = deflated(p, Real(-t0));
    const Real bound = Real(2) * (s.major + s.minor) / sqrt(a);
    std::vector<Real> roots = real_roots(p, bound);
    for (Real& t : roots) t += t0;
    return roots;
}

/// Calls found(t) for every crossing of the line with the surface but that in which the ray starts.
template <class Real, class Found>
void for_crossings(const Primitive<Real>& s, const Along<Real>& q, const Ray<Real>& ray, const Found& found)
{
    if (q.settled) return;
    if (s.shape == Shape::torus) {
        for (const Real& t : torus_crossings(s, ray, q.from_surface)) found(t);
        return;
    }
    if (q.from_surface) {
        if (q.a != 0) found(Real(Real(-2) * q.b / q.a));
        return;
    }
    if (q.a == 0) {
        if (q.b != 0) found(Real(-q.c / (Real(2) * q.b)));
        return;
    }
    const Real discriminant = q.b * q.b - q.a * q.c;
    if (discriminant < 0) return;
    const Real root = sqrt(discriminant);
    const Real k = q.b < 0 ? Real(root - q.b) : Real(-root - q.b);
    found(Real(k / q.a));
    if (k != 0) found(Real(q.c / k));
}

/// A boolean tree over the primitives of one object; nodes[root] is the whole.
struct Tree {
    enum class Kind : std::uint8_t { primitive, complement, all, any };
    struct Node {
        Kind kind = Kind::primitive;
        std::uint32_t primitive = 0;
        std::vector<std::uint32_t> of;
    };
    std::vector<Node> nodes;
    std::uint32_t root = 0;
};

/// holds(primitive) says whether a point lies in a primitive.
template <class Holds>
bool contains(const Tree& tree, std::uint32_t at, const Holds& holds)
{
    const Tree::Node& node = tree.nodes[at];
    const auto part = [&](std::uint32_t child) { return contains(tree, child, holds); };
    switch (node.kind) {
    case Tree::Kind::primitive: return holds(node.primitive);
    case Tree::Kind::complement: return !part(node.of[0]);
    case Tree::Kind::all: return std::all_of(node.of.begin(), node.of.end(), part);
    case Tree::Kind::any: return std::any_of(node.of.begin(), node.of.end(), part);
    }
    return false;
}

} // namespace clucida::oracle
