/// Rays that try a solid: through it from near and far, grazing it, along its asymptotes, and leaving it.
#pragma once

#include "many_rays_judge.h"
#include "many_rays_solids.h"

namespace clucida::test {

/// A unit direction that the core's renormalization leaves as it is: its length is 1 to half an ulp, and no component
/// stands just above a gap that halves.
template <typename P>
bool is_exact(Vec3 d)
{
    using W = typename P::Wide;
    const W defect = 1 - (W(d.x) * d.x + W(d.y) * d.y + W(d.z) * d.z);
    if (magnitude(defect) >= W(P::u)) return false;
    int exponent = 0;
    for (const double v : {d.x, d.y, d.z})
        if (defect != 0 && std::fabs(std::frexp(v, &exponent)) == 0.5) return false;
    return true;
}

/// The first of a few tries whose length is exact enough; each try makes a direction anew.
template <typename P, typename Make>
std::optional<Vec3> exact_of(const Make& make)
{
    for (int i = 0; i < 20; i++) {
        const Vec3 d = to_real<P>(scene::unit(make()));
        if (is_exact<P>(d)) return d;
    }
    return std::nullopt;
}

template <typename W>
Vec3 narrow(const Wide3<W>& v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

inline Vec3 perpendicular(Random& random, Vec3 n)
{
    while (true) {
        const Vec3 v = scene::cross(n, random_direction(random));
        if (scene::length(v) > .1) return scene::unit(v);
    }
}

inline double random_distance(Random& random, double size)
{
    return size * log_uniform(random, 1e-4, 1e6);
}

/// Aimed at the solid's surroundings.
template <typename P>
std::optional<Path> through(Random& random, double size)
{
    const Vec3 o = to_real<P>(random_direction(random) * random_distance(random, size));
    const auto d = exact_of<P>([&] { return random_in_box(random, 1.25 * size) - o; });
    if (!d) return std::nullopt;
    return Path{o, *d, MEMBER_NONE, false};
}

/// A point on the surface and the normal there, by a line through the solid's surroundings.
template <typename W>
std::optional<std::pair<Vec3, Vec3>> surface_point(Random& random, const Target<W>& target)
{
    const auto& member = target.leaf.members[random() % target.leaf.members.size()];
    const Wide3<W> o = widen<W>(random_in_box(random, static_cast<double>(target.size)));
    const Wide3<W> d = widen<W>(random_direction(random));
    std::vector<Root<W>> roots;
    member.append_roots(o, d, W(0), roots);
    if (roots.empty()) return std::nullopt;
    const Wide3<W> at = along(o, d, roots[random() % roots.size()].t);
    const Vec3 g = narrow(member.gradient(at)), p = narrow(at);
    if (!(scene::length(p) < 100 * static_cast<double>(target.size)) || !(scene::length(g) > 0)) return std::nullopt;
    return std::pair{p, scene::unit(g)};
}

/// Nearly tangent at a point of the surface.
template <typename P>
std::optional<Path> grazing(Random& random, const Target<typename P::Wide>& target)
{
    const auto point = surface_point(random, target);
    if (!point) return std::nullopt;
    const auto& [p, n] = *point;
    const double tilt = log_uniform(random, 1e-7, .3) * (random() % 2 == 0 ? 1 : -1);
    const auto d = exact_of<P>([&] { return perpendicular(random, n) + n * tilt; });
    if (!d) return std::nullopt;
    const Vec3 o = to_real<P>(p - *d * random_distance(random, static_cast<double>(target.size)));
    return Path{o, *d, MEMBER_NONE, false};
}

/// A direction in which the quadric's leading coefficient vanishes: a generator of its asymptotic cone, or its axis.
template <typename W>
std::optional<Vec3> asymptote(Random& random, const Primitive<W>& q)
{
    std::array<double, 3> x{};
    const double angle = uniform(random, 0, 2 * std::numbers::pi);
    const double side = random() % 2 == 0 ? 1 : -1, other = uniform(random, -1, 1);
    if (q.s == Wide3<W>{1, 1, -1})
        x = {std::cos(angle), std::sin(angle), 1};
    else if (q.s == Wide3<W>{-1, 1, 0} || q.s == Wide3<W>{1, -1, 0})
        x = {1, side, other};
    else if (q.s == Wide3<W>{1, 0, -1})
        x = {1, other, side};
    else if (q.s == Wide3<W>{1, 1, 0})
        x = {0, 0, 1};
    else if (q.s == Wide3<W>{1, 0, 0})
        x = {0, side, other};
    else
        return std::nullopt;
    scene::Mat3 m;
    for (int i = 0; i < 3; i++) m.rows[i] = narrow(q.m[i]);
    return scene::unit(scene::inverse(m) * Vec3{x[0], x[1], x[2]});
}

template <typename P>
std::optional<Path> asymptotic(Random& random, const Target<typename P::Wide>& target)
{
    const auto axis = asymptote(random, target.leaf.members[0]);
    if (!axis) return grazing<P>(random, target);
    const double size = static_cast<double>(target.size), tilt = log_uniform(random, 1e-9, 1e-1);
    const auto d = exact_of<P>([&] { return *axis + random_direction(random) * tilt; });
    if (!d) return std::nullopt;
    const Vec3 o = to_real<P>(random_in_box(random, 1.25 * size) - *d * random_distance(random, size));
    return Path{o, *d, MEMBER_NONE, false};
}

/// Leaves the surface at a hit for its far side (ahead) or back; every second one at a slant, down to a cosine of 1e-6.
template <typename P>
std::optional<Path> departing(Random& random, const Target<typename P::Wide>& target, std::size_t member,
                              const Hit& hit, bool ahead)
{
    using W = typename P::Wide;
    const Wide3<W> g = target.leaf.members[member].gradient(widen<W>(hit.p));
    const bool to_inside = hit.beyond_inside == ahead;
    const Vec3 n = scene::unit(narrow(g)) * (to_inside ? -1 : 1);
    const double cosine = random() % 2 == 0 ? uniform(random) : log_uniform(random, 1e-6, 1);
    const auto d = exact_of<P>([&] { return perpendicular(random, n) * std::sqrt(1 - cosine * cosine) + n * cosine; });
    // Rounding may have turned it to the surface's other side.
    if (!d || !(scene::dot(*d, n) > cosine / 2)) return std::nullopt;
    return Path{hit.p, *d, hit.left, to_inside};
}

} // namespace clucida::test
