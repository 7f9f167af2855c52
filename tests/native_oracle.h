/// Where a line crosses the primitives that lie in a scene's buffers: textbook quadratics in a type wide enough that
/// they do not cancel. Shares nothing with the kernels but the numbers in the buffers.
#pragma once

#include "native_scene.h"

#include <algorithm>

namespace clucida::test {

template <typename W>
using Wide3 = std::array<W, 3>;

template <typename W>
Wide3<W> widen(Vec3 v)
{
    return {W(v.x), W(v.y), W(v.z)};
}
template <typename W>
W dot(const Wide3<W>& a, const Wide3<W>& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <typename W>
Wide3<W> along(const Wide3<W>& o, const Wide3<W>& d, W t)
{
    return {o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]};
}
template <typename W>
W magnitude(W x)
{
    return x < 0 ? -x : x;
}

/// A crossing of a line: slope is 1/cos of its angle to the normal.
template <typename W>
struct Root {
    W t, slope;
};

/// A t^2 + 2 B t + C, and the sizes of what A and B^2 - A C were summed up from.
template <typename W>
struct Parabola {
    W a, b, c, a_size, d_size;
};

/// a[0] + a[1] t + ...
template <typename W, std::size_t N>
W polynomial(const std::array<W, N>& a, W t)
{
    W sum = 0;
    for (std::size_t i = N; i-- > 0;) sum = sum * t + a[i];
    return sum;
}

template <typename W, std::size_t N>
std::array<W, N - 1> derivative(const std::array<W, N>& a)
{
    std::array<W, N - 1> slope;
    for (std::size_t i = 1; i < N; i++) slope[i - 1] = a[i] * W(static_cast<int>(i));
    return slope;
}

/// Places along a line, no more than a quartic has roots. No vector, for some tests ask for millions.
template <typename W>
struct Places {
    std::array<W, 4> t{};
    std::size_t count = 0;
    void push(W place) { t[count++] = place; }
    const W* begin() const { return t.data(); }
    const W* end() const { return t.data() + count; }
};

/// Where a polynomial changes its sign, if it does so once between two places: Newton's method while its steps shrink
/// to a half, else bisection, until rounding decides the value's sign.
template <typename W, std::size_t N>
W sign_change(const std::array<W, N>& a, W from, W to)
{
    const W roundoff = std::is_same_v<W, Quad> ? 0x1p-113L : 0x1p-64L;
    const bool rising = polynomial(a, from) < 0;
    W t = (from + to) / 2, last = to - from;
    for (int step = 0; step < 200 && from < t && t < to; step++) {
        W value = 0, slope = 0, size = 0;
        for (std::size_t i = N; i-- > 0;) {
            slope = slope * t + value;
            value = value * t + a[i];
            size = size * magnitude(t) + magnitude(a[i]);
        }
        if (magnitude(value) <= 2 * roundoff * size) break;
        ((value < 0) == rising ? from : to) = t;
        W next = t - value / slope;
        if (!(from < next && next < to && 2 * magnitude(next - t) <= last)) next = (from + to) / 2;
        last = magnitude(next - t);
        t = next;
    }
    return t;
}

/// The same between low and high, of any number of changes: one lies between neighbouring turns at most.
template <typename W, std::size_t N>
Places<W> sign_changes(const std::array<W, N>& a, const Places<W>& turns, W low, W high)
{
    Places<W> found;
    W from = low;
    const auto up_to = [&](W to) {
        if ((polynomial(a, from) < 0) != (polynomial(a, to) < 0)) found.push(sign_change(a, from, to));
        from = to;
    };
    for (const W& turn : turns)
        if (low < turn && turn < high) up_to(turn);
    up_to(high);
    return found;
}

template <typename W>
Places<W> sign_changes(const std::array<W, 3>& a, W low, W high)
{
    Places<W> found;
    const W half = a[1] / 2, discriminant = half * half - a[0] * a[2];
    if (!(discriminant > 0)) return found;
    const W q = -(half + (half < 0 ? -root(discriminant) : root(discriminant)));
    for (const W& t : {std::min(q / a[2], a[0] / q), std::max(q / a[2], a[0] / q)})
        if (low < t && t < high) found.push(t);
    return found;
}
template <typename W>
Places<W> sign_changes(const std::array<W, 4>& a, W low, W high)
{
    return sign_changes(a, sign_changes(derivative(a), low, high), low, high);
}

/// X = m (p - c); q = sum s X^2 + 2 sum l X + w < 0 inside: planes, spheres and quadrics alike. Or, if it has a major
/// radius, a torus about m[2].
template <typename W>
struct Primitive {
    Wide3<W> c{}, s{}, l{};
    std::array<Wide3<W>, 3> m{Wide3<W>{1, 0, 0}, Wide3<W>{0, 1, 0}, Wide3<W>{0, 0, 1}};
    W w = 0, major = 0, minor = 0;

    Wide3<W> local(const Wide3<W>& p) const
    {
        const Wide3<W> v{p[0] - c[0], p[1] - c[1], p[2] - c[2]};
        return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
    }
    W value(const Wide3<W>& p) const
    {
        const Wide3<W> x = local(p);
        if (major > 0) {
            const W across = root(x[0] * x[0] + x[1] * x[1]) - major;
            return root(across * across + x[2] * x[2]) - minor;
        }
        W q = w;
        for (int i = 0; i < 3; i++) q += s[i] * x[i] * x[i] + 2 * l[i] * x[i];
        return q;
    }
    Wide3<W> gradient(const Wide3<W>& p) const
    {
        const Wide3<W> x = local(p);
        Wide3<W> g{};
        if (major > 0) {
            const W rho = root(x[0] * x[0] + x[1] * x[1]), across = rho - major;
            const W size = root(across * across + x[2] * x[2]);
            for (int j = 0; j < 3; j++)
                g[j] = (across * (x[0] * m[0][j] + x[1] * m[1][j]) / rho + x[2] * m[2][j]) / size;
            return g;
        }
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) g[j] += 2 * (s[i] * x[i] + l[i]) * m[i][j];
        return g;
    }
    /// A shift by e changes the value by at most |gradient| e + curvature e^2.
    W curvature() const
    {
        W most = 0;
        for (int i = 0; i < 3; i++) most = std::max(most, magnitude(s[i]) * dot(m[i], m[i]));
        return most;
    }
    Parabola<W> parabola(const Wide3<W>& o, const Wide3<W>& d) const
    {
        const Wide3<W> x = local(o), v{dot(m[0], d), dot(m[1], d), dot(m[2], d)};
        Parabola<W> p{0, 0, w, 0, 0};
        W c_size = magnitude(w);
        for (int i = 0; i < 3; i++) {
            p.a += s[i] * v[i] * v[i];
            p.b += (s[i] * x[i] + l[i]) * v[i];
            p.c += s[i] * x[i] * x[i] + 2 * l[i] * x[i];
            p.a_size += magnitude(s[i]) * v[i] * v[i];
            c_size += magnitude(s[i]) * x[i] * x[i] + 2 * magnitude(l[i] * x[i]);
        }
        p.d_size = p.b * p.b + p.a_size * c_size;
        return p;
    }
    W slope(const Wide3<W>& p, const Wide3<W>& d) const
    {
        const Wide3<W> g = gradient(p);
        const W along_d = magnitude(dot(g, d));
        return along_d > 0 ? root(dot(g, g)) / along_d : W(1e30L);
    }
    /// A torus along a line near it: the quartic (|p|^2 + R^2 - r^2)^2 - 4 R^2 rho^2.
    std::array<W, 5> torus_quartic(const Wide3<W>& o, const Wide3<W>& d) const
    {
        const Wide3<W> x = local(o), v{dot(m[0], d), dot(m[1], d), dot(m[2], d)};
        const W dd = dot(v, v), xv = dot(x, v), four = 4 * major * major;
        const W k = dot(x, x) + major * major - minor * minor;
        return {k * k - four * (x[0] * x[0] + x[1] * x[1]), 4 * k * xv - 2 * four * (x[0] * v[0] + x[1] * v[1]),
                2 * k * dd + 4 * xv * xv - four * (v[0] * v[0] + v[1] * v[1]), 4 * xv * dd, dd * dd};
    }
    /// From the point nearest to the centre, in a type wide enough; false if the line comes within `rounding` of the
    /// surface where it turns.
    bool append_torus_roots(const Wide3<W>& o, const Wide3<W>& d, W rounding, std::vector<Root<W>>& out) const
    {
        const W shift = -dot(Wide3<W>{o[0] - c[0], o[1] - c[1], o[2] - c[2]}, d) / dot(d, d);
        const Wide3<W> near = along(o, d, shift), x = local(near);
        const W far = 2 * (major + minor);
        if (dot(x, x) > far * far) return true;
        const std::array<W, 5> quartic = torus_quartic(near, d);
        const Places<W> turns = sign_changes(derivative(quartic), -far, far);
        for (const W& t : sign_changes(quartic, turns, -far, far))
            out.push_back({shift + t, this->slope(along(near, d, t), d)});
        bool sure = true;
        for (const W& t : turns) sure = sure && magnitude(value(along(near, d, t))) > rounding * (major + minor);
        return sure;
    }
    /// Appends the crossings; false if the discriminant or leading coefficient lies within `rounding` of 0.
    bool append_roots(const Wide3<W>& o, const Wide3<W>& d, W rounding, std::vector<Root<W>>& out) const
    {
        if (major > 0) return append_torus_roots(o, d, rounding, out);
        const W shift = -dot(Wide3<W>{o[0] - c[0], o[1] - c[1], o[2] - c[2]}, d);
        const Wide3<W> near = along(o, d, shift);
        const Parabola<W> p = parabola(near, d);
        const auto push = [&](W t) { out.push_back({shift + t, slope(along(near, d, t), d)}); };
        if (p.a_size == 0) { // a plane
            if (p.b != 0) push(-p.c / (2 * p.b));
            return magnitude(p.b) > rounding * root(dot(l, l));
        }
        const W discriminant = p.b * p.b - p.a * p.c;
        if (p.a != 0 && discriminant > 0) {
            const W q = -(p.b + (p.b < 0 ? -root(discriminant) : root(discriminant)));
            push(q / p.a);
            push(p.c / q);
        } else if (p.a == 0 && p.b != 0) {
            push(-p.c / (2 * p.b));
        }
        return magnitude(discriminant) > rounding * p.d_size && (p.a == 0 || magnitude(p.a) > rounding * p.a_size);
    }
};

/// The primitives of an object's only group (a torus has two), and whether it is their complement.
template <typename W>
struct Leaf {
    std::vector<Primitive<W>> members;
    bool inverse = false;
    bool holds(const Wide3<W>& p) const
    {
        return std::ranges::all_of(members, [&](const auto& m) { return m.value(p) < 0; }) != inverse;
    }
};

template <typename W>
Primitive<W> primitive_of(const Native& scene, const LayoutObject& object, u32 member)
{
    const u32 index = member >> MEMBER_SHIFT;
    Primitive<W> p;
    for (int i = 0; i < 3; i++) p.c[i] = object.center[i];
    switch (member & MEMBER_KIND) {
    case MEMBER_PLANE: {
        const LayoutPlane& plane = scene.items<LayoutPlane>(BUFFER_PLANES)[index];
        for (int i = 0; i < 3; i++) p.l[i] = W(plane.n[i]) / 2;
        p.w = -W(plane.h);
        break;
    }
    case MEMBER_SPHERE: {
        const LayoutSphere& ball = scene.items<LayoutSphere>(BUFFER_SPHERES)[index];
        for (int i = 0; i < 3; i++) p.c[i] += W(ball.c[i]);
        p.s = {1, 1, 1};
        p.w = -W(ball.r) * W(ball.r);
        break;
    }
    case MEMBER_TORUS: {
        const LayoutTorus& torus = scene.items<LayoutTorus>(BUFFER_TORI)[index >> 1];
        Wide3<W> z{}, x{};
        for (int i = 0; i < 3; i++) {
            p.c[i] += W(torus.c[i]);
            z[i] = torus.axis[i];
        }
        const W size = root(dot(z, z));
        for (W& v : z) v /= size;
        x[magnitude(z[0]) < W(0.5L) ? 0 : 1] = 1;
        const W up = dot(x, z);
        for (int i = 0; i < 3; i++) x[i] -= up * z[i];
        const W side = root(dot(x, x));
        for (W& v : x) v /= side;
        p.m = {x, {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]}, z};
        p.major = torus.major;
        p.minor = torus.minor;
        break;
    }
    default: {
        const LayoutQuadric& q = scene.items<LayoutQuadric>(BUFFER_QUADRICS)[index];
        for (int i = 0; i < 3; i++) {
            p.c[i] += W(q.c[i]);
            p.s[i] = q.s[i];
            for (int j = 0; j < 3; j++) p.m[i][j] = q.m[3 * i + j];
        }
        p.l[2] = -W(q.g);
        p.w = q.w;
    }
    }
    return p;
}

template <typename W>
Leaf<W> leaf_of(const Native& scene, u32 id)
{
    const LayoutObject& object = scene.items<LayoutObject>(BUFFER_OBJECTS)[id];
    const LayoutGroup& group = scene.items<LayoutGroup>(BUFFER_GROUPS)[object.group_begin];
    // A torus has two, one for each interval of a line: the first shows it all.
    const bool torus = (scene.items<u32>(BUFFER_MEMBERS)[group.begin] & MEMBER_KIND) == MEMBER_TORUS;
    EXPECT_EQ(object.group_count, torus ? 2U : 1U);
    Leaf<W> leaf;
    leaf.inverse = group.inverse != 0;
    for (u32 i = 0; i < group.count; i++)
        leaf.members.push_back(primitive_of<W>(scene, object, scene.items<u32>(BUFFER_MEMBERS)[group.begin + i]));
    return leaf;
}

} // namespace clucida::test
