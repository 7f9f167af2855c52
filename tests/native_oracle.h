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

/// X = m (p - c); q = sum s X^2 + 2 sum l X + w < 0 inside: planes, spheres and quadrics alike.
template <typename W>
struct Primitive {
    Wide3<W> c{}, s{}, l{};
    std::array<Wide3<W>, 3> m{Wide3<W>{1, 0, 0}, Wide3<W>{0, 1, 0}, Wide3<W>{0, 0, 1}};
    W w = 0;

    Wide3<W> local(const Wide3<W>& p) const
    {
        const Wide3<W> v{p[0] - c[0], p[1] - c[1], p[2] - c[2]};
        return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
    }
    W value(const Wide3<W>& p) const
    {
        const Wide3<W> x = local(p);
        W q = w;
        for (int i = 0; i < 3; i++) q += s[i] * x[i] * x[i] + 2 * l[i] * x[i];
        return q;
    }
    Wide3<W> gradient(const Wide3<W>& p) const
    {
        const Wide3<W> x = local(p);
        Wide3<W> g{};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) g[j] += 2 * (s[i] * x[i] + l[i]) * m[i][j];
        return g;
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
    /// Appends the crossings; false if the discriminant or leading coefficient lies within `rounding` of 0.
    bool append_roots(const Wide3<W>& o, const Wide3<W>& d, W rounding, std::vector<Root<W>>& out) const
    {
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

/// The primitives of an object's only group, and whether it is their complement.
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
    EXPECT_EQ(object.group_count, 1U);
    const LayoutGroup& group = scene.items<LayoutGroup>(BUFFER_GROUPS)[object.group_begin];
    Leaf<W> leaf;
    leaf.inverse = group.inverse != 0;
    for (u32 i = 0; i < group.count; i++)
        leaf.members.push_back(primitive_of<W>(scene, object, scene.items<u32>(BUFFER_MEMBERS)[group.begin + i]));
    return leaf;
}

} // namespace clucida::test
