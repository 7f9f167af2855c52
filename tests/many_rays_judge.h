/// Which event must come first along a ray, in a type wide enough beside the kernel's, and how far from it the kernel
/// is.
#pragma once

#include "native_oracle.h"

namespace clucida::test {

/// A leaf whose members know the references by which the kernels name them.
template <typename W>
struct Target {
    Leaf<W> leaf;
    std::vector<u32> references;
    W size = 1; ///< of the solid
};

template <typename W>
Target<W> target_of(const Native& scene, double size)
{
    Target<W> target{leaf_of<W>(scene, 0), {}, W(size)};
    const LayoutGroup& group = scene.items<LayoutGroup>(BUFFER_GROUPS)[0];
    for (u32 i = 0; i < group.count; i++)
        target.references.push_back(scene.items<u32>(BUFFER_MEMBERS)[group.begin + i] & ~MEMBER_INVERSE);
    return target;
}

/// A crossing of one member; doubtful where rounding decides on which side of infinity it lies. Where the ray has left
/// the member, t follows from its start's being on it, and twin is where the line as it is meets it: the start is off
/// by a rounding, and which of the two is meant is open.
template <typename W>
struct MemberRoot {
    W t, twin, slope;
    std::size_t member;
    bool doubtful;
};

/// What counts as near, in sizes: a line to a surface that it grazes; two members' boundaries to each other.
template <typename W>
struct Rounding {
    W root, edge;
};

template <typename W>
struct First {
    bool unsure = false; ///< rounding may decide it
    bool hit = false, inside = false;
    std::size_t member = 0;
    W t = 0, twin = 0;
};

template <typename W>
W size_at(const Target<W>& target, const Wide3<W>& p)
{
    // A solid is as large as where it is met: one without bounds has no other size.
    return std::max(target.size, root(dot(p, p)));
}

template <typename W>
bool append_torus(const Primitive<W>& torus, std::size_t i, const Wide3<W>& o, const Wide3<W>& d, W rounding,
                  std::vector<MemberRoot<W>>& out)
{
    static thread_local std::vector<Root<W>> roots;
    roots.clear();
    const bool sure = torus.append_torus_roots(o, d, rounding, roots);
    for (const Root<W>& r : roots)
        if (r.t > 0) out.push_back({r.t, r.t, r.slope, i, false});
    return sure;
}

/// What is left of a torus's quartic where the ray leaves it at o. False where the line turns within rounding of it
/// further on.
template <typename W>
bool append_deflated_torus(const Primitive<W>& torus, std::size_t i, const Wide3<W>& o, const Wide3<W>& d, W rounding,
                           std::vector<MemberRoot<W>>& out)
{
    const W size = torus.major + torus.minor, far = 4 * size;
    const std::array<W, 5> quartic = torus.torus_quartic(o, d);
    const std::array<W, 4> cubic{quartic[1], quartic[2], quartic[3], quartic[4]};
    const Places<W> turns = sign_changes(derivative(quartic), -far, far), ahead = sign_changes(cubic, W(0), far);
    const Places<W> twins = ahead.count > 0 ? sign_changes(quartic, turns, -far, far) : Places<W>{};
    for (const W& t : ahead) {
        W twin = t, apart = t / 2;
        for (const W& s : twins) {
            if (magnitude(s - t) > apart) continue;
            apart = magnitude(s - t);
            twin = s;
        }
        out.push_back({t, twin, torus.slope(along(o, d, twin), d), i, false});
    }
    // On its way to the first turn the line is on its own side, however near to the surface.
    bool sure = true, first = true;
    for (const W& t : turns) {
        if (t <= 0) continue;
        sure = sure && (first || magnitude(torus.value(along(o, d, t))) > rounding * size);
        first = false;
    }
    return sure;
}

/// Appends where the line crosses member i at t > 0. False if rounding decides whether it does: if the line comes no
/// deeper into the surface (or no nearer to it) than `rounding` sizes. For a sphere that is |D| <= 2 rounding r^2.
template <typename W>
bool append_crossings(const Target<W>& target, std::size_t i, const Wide3<W>& o, const Wide3<W>& d, W rounding,
                      std::vector<MemberRoot<W>>& out)
{
    const Primitive<W>& member = target.leaf.members[i];
    if (member.major > 0) return append_torus(member, i, o, d, rounding, out);
    const W shift = -dot(Wide3<W>{o[0] - member.c[0], o[1] - member.c[1], o[2] - member.c[2]}, d);
    const Wide3<W> near = along(o, d, shift);
    const Parabola<W> p = member.parabola(near, d);
    const auto push = [&](W t, bool doubtful) {
        if (shift + t > 0 || doubtful)
            out.push_back({shift + t, shift + t, member.slope(along(near, d, t), d), i, doubtful});
    };
    if (p.a_size == 0) { // a plane
        if (p.b != 0) push(-p.c / (2 * p.b), magnitude(p.b) <= rounding * root(dot(member.l, member.l)));
        return true;
    }
    const W discriminant = p.b * p.b - p.a * p.c;
    const bool flat = magnitude(p.a) <= rounding * p.a_size; // A might as well have the other sign
    if (discriminant > 0) {
        const W q = -(p.b + (p.b < 0 ? -root(discriminant) : root(discriminant)));
        push(p.c / q, flat && rounding * p.a_size * magnitude(p.c) > discriminant / 2);
        if (p.a != 0) push(q / p.a, flat);
    }
    if (p.a == 0) return true;
    if (flat && discriminant <= 0) return false;
    const Wide3<W> middle = along(near, d, -p.b / p.a), g = member.gradient(middle);
    const W blur = rounding * size_at(target, middle);
    return magnitude(discriminant / p.a) > blur * (root(dot(g, g)) + blur * member.curvature());
}

/// The other crossing of a member that the ray leaves at o, where one lies by definition.
template <typename W>
void append_deflated(const Primitive<W>& member, std::size_t i, const Wide3<W>& o, const Wide3<W>& d, W rounding,
                     std::vector<MemberRoot<W>>& out)
{
    const Parabola<W> p = member.parabola(o, d);
    if (p.a == 0) return;
    const bool doubtful = magnitude(p.a) <= rounding * p.a_size;
    const W t = -2 * p.b / p.a;
    if (!(t > 0) && !doubtful) return;
    const W discriminant = p.b * p.b - p.a * p.c;
    const W twin = discriminant > 0 ? t / 2 + root(discriminant) / magnitude(p.a) : t;
    out.push_back({t, twin, member.slope(along(o, d, t), d), i, doubtful});
}

/// Whether another member is met within rounding of root k, at an edge: where all others hold the place.
template <typename W>
bool at_edge(const Target<W>& target, const std::vector<MemberRoot<W>>& roots, std::size_t k,
             const std::vector<char>& in, std::size_t holding, const Wide3<W>& o, const Wide3<W>& d, W rounding)
{
    const MemberRoot<W>& r = roots[k];
    const W blur = rounding * size_at(target, along(o, d, r.t));
    return std::ranges::any_of(roots, [&](const MemberRoot<W>& n) {
        return n.member != r.member && magnitude(n.t - r.t) <= blur * (n.slope + r.slope) &&
               holding + 2 >= target.leaf.members.size() + static_cast<std::size_t>(in[r.member] + in[n.member]);
    });
}

/// left: the member that the ray leaves (or more than there are), on its inside or outside. It counts as unsure that
/// two members are crossed within rounding of one another, or that the start lies within rounding of a boundary.
template <typename W>
First<W> first_event(const Target<W>& target, const Wide3<W>& o, const Wide3<W>& d, std::size_t left, bool left_inside,
                     Rounding<W> rounding)
{
    static thread_local std::vector<MemberRoot<W>> roots;
    static thread_local std::vector<char> in;
    roots.clear();
    in.clear();
    const auto& members = target.leaf.members;
    First<W> e;
    std::size_t holding = 0;
    const W far = target.size + root(dot(o, o));
    for (std::size_t i = 0; i < members.size(); i++) {
        if (i == left) {
            if (members[i].major > 0)
                e.unsure |= !append_deflated_torus(members[i], i, o, d, rounding.root, roots);
            else
                append_deflated(members[i], i, o, d, rounding.root, roots);
            in.push_back(left_inside);
        } else {
            const Wide3<W> g = members[i].gradient(o);
            const W value = members[i].value(o);
            const W near = rounding.edge * far;
            e.unsure |= value * value <= near * near * dot(g, g);
            e.unsure |= !append_crossings(target, i, o, d, rounding.root, roots);
            in.push_back(value < 0);
        }
        holding += in.back();
    }
    std::ranges::sort(roots, [](const auto& a, const auto& b) { return a.t < b.t; });
    e.inside = (holding == members.size()) != target.leaf.inverse;
    bool doubtful = false;
    for (std::size_t k = 0; k < roots.size() && !e.hit; k++) {
        const MemberRoot<W>& r = roots[k];
        doubtful |= r.doubtful;
        if (r.t <= 0) continue;
        e.unsure |= members.size() > 1 && at_edge(target, roots, k, in, holding, o, d, rounding.edge);
        holding = in[r.member] ? holding - 1 : holding + 1;
        in[r.member] = in[r.member] == 0;
        if (((holding == members.size()) != target.leaf.inverse) == e.inside) continue;
        e.hit = true;
        doubtful = r.doubtful;
        e.t = r.t;
        e.twin = r.twin;
        e.member = r.member;
    }
    e.unsure |= doubtful;
    return e;
}

/// |p - at| x cos over u x size, where the ray's first event lies at `at`. The angle is that at which the line as it is
/// meets the surface.
template <typename W>
double error_units(const Target<W>& target, const First<W>& e, const Wide3<W>& o, const Wide3<W>& d, Vec3 p, double u)
{
    const W slope = target.leaf.members[e.member].slope(along(o, d, e.twin), d);
    const auto units = [&](W t) {
        const Wide3<W> at = along(o, d, t);
        const Wide3<W> off{W(p.x) - at[0], W(p.y) - at[1], W(p.z) - at[2]};
        return static_cast<double>(root(dot(off, off)) / slope / (size_at(target, at) * W(u)));
    };
    return e.twin == e.t ? units(e.t) : std::min(units(e.t), units(e.twin));
}

} // namespace clucida::test
