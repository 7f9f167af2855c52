/// Generators of solids, rays and scenes for RapidCheck, and how a counterexample shows itself. Coordinates are
/// multiples of 1/64 that shrink to 0, sizes powers of two that shrink to 1, boolean trees shrink to their parts.
#pragma once

#include "property_maps.h"
#include "quadric_of.h"

#include "scene/write.h"

#include <ostream>
#include <rapidcheck.h>

namespace clucida::scene {
inline void showValue(const Vec3& v, std::ostream& out)
{
    out << '[' << v.x << ", " << v.y << ", " << v.z << ']';
}
} // namespace clucida::scene

namespace clucida::test {

/// A solid about the origin, some units large; shown as a scene's text.
struct Body {
    SolidPtr solid;
};
inline std::ostream& operator<<(std::ostream& out, const Body& body)
{
    return out << scene::print_scene(scene_of({body.solid}));
}

/// A ray that passes near the origin.
struct Beam {
    Vec3 o, d;
};
inline std::ostream& operator<<(std::ostream& out, const Beam& beam)
{
    return out << std::hexfloat << "from " << beam.o.x << ' ' << beam.o.y << ' ' << beam.o.z << " along " << beam.d.x
               << ' ' << beam.d.y << ' ' << beam.d.z << std::defaultfloat;
}

namespace generate {

using rc::Gen;
namespace gen = rc::gen;

/// -most..most, the whole of it at any of RapidCheck's sizes; shrinks to 0.
inline Gen<int> whole(int most)
{
    const auto zigzag = [](int k) { return k % 2 == 0 ? -(k / 2) : k / 2 + 1; };
    return gen::map(gen::resize(rc::kNominalSize, gen::inRange(0, 2 * most + 1)), zigzag);
}
inline Gen<double> coordinate(double most)
{
    return gen::map(whole(static_cast<int>(64 * most)), [](int k) { return k / 64.0; });
}
inline Gen<Vec3> place(double most = 1)
{
    const auto join = [](double x, double y, double z) { return Vec3{x, y, z}; };
    return gen::apply(join, coordinate(most), coordinate(most), coordinate(most));
}
inline Gen<Vec3> arrow()
{
    return gen::map(place(1), [](Vec3 v) { return scene::length(v) < .25 ? Vec3{0, 0, 1} : v; });
}
/// 2^-2..2, log-uniform.
inline Gen<double> size()
{
    return gen::map(whole(8), [](int k) { return std::exp2((k > 0 ? .125 : .25) * k); });
}
/// The size of a whole scene: 2^-13..2^20.
inline Gen<int> exponent()
{
    return gen::map(whole(20), [](int k) { return std::max(k, -13); });
}

template <typename Node, typename... Ts>
Gen<SolidPtr> node(Gen<Ts>... values)
{
    return gen::apply([](Ts... v) { return solid(Node{v...}); }, values...);
}

inline SolidPtr ellipsoid(Vec3 center, Vec3 axis, int degrees, double x, double y, double z)
{
    const SolidPtr scaled = solid(scene::Transformed{scene::Scale{{x, y, z}}, sphere({0, 0, 0}, 1)});
    const SolidPtr turned = solid(scene::Transformed{scene::Rotate{axis, static_cast<double>(degrees)}, scaled});
    return solid(scene::Transformed{scene::Move{center}, turned});
}

/// Turned by any angle about any axis, of any kind but planes.
inline SolidPtr free_quadric(Vec3 center, Vec3 axis, int degrees, Vec3 sizes, int kind)
{
    static constexpr std::array<std::array<Vec3, 2>, 9> terms{{{{{1, 1, 1}, {}}},
                                                               {{{1, 1, -1}, {}}},
                                                               {{{1, 1, -1}, {}}},
                                                               {{{1, 1, -1}, {}}},
                                                               {{{1, 1, 0}, {0, 0, -1}}},
                                                               {{{1, -1, 0}, {0, 0, -1}}},
                                                               {{{1, 1, 0}, {}}},
                                                               {{{1, -1, 0}, {}}},
                                                               {{{1, 0, 0}, {0, 0, -1}}}}};
    static constexpr std::array<double, 9> constant{-1, -1, 1, 0, 0, 0, -1, 1, 0};
    scene::Mat3 m = scene::rotation(axis, degrees);
    m.rows = {m.rows[0] * (1 / sizes.x), m.rows[1] * (1 / sizes.y), m.rows[2] * (1 / sizes.z)};
    const auto k = static_cast<std::size_t>(kind);
    return quadric_of(m, center, terms[k][0], terms[k][1], constant[k]);
}

inline SolidPtr torus(Vec3 center, Vec3 axis, double size, double part)
{
    return solid(scene::Torus{center, axis, size, size * part});
}

/// Every primitive.
inline Gen<SolidPtr> primitive()
{
    const auto sized_arrow = gen::apply([](Vec3 v, double s) { return scene::unit(v) * s; }, arrow(), size());
    const auto sizes = gen::apply([](double x, double y, double z) { return Vec3{x, y, z}; }, size(), size(), size());
    const auto across = gen::map(arrow(), [](Vec3 v) { return v + Vec3{1. / 3, 1. / 7, 1. / 11}; });
    return gen::oneOf(
        node<scene::Sphere>(place(), size()), node<scene::Plane>(place(), arrow()),
        node<scene::Cylinder>(place(), sized_arrow), node<scene::Cone>(place(), sized_arrow),
        node<scene::Paraboloid>(place(), sized_arrow), node<scene::Hyperboloid>(place(), sized_arrow, size()),
        node<scene::Saddle>(place(), sized_arrow, across), node<scene::Cuboid>(place(), arrow(), across, sizes),
        gen::apply(ellipsoid, place(), arrow(), whole(180), size(), size(), size()),
        gen::apply(torus, place(), arrow(), size(),
                   gen::map(whole(3), [](int k) { return k > 0 ? k / 4.0 : std::exp2(k - 1); })),
        gen::apply(free_quadric, place(), arrow(), whole(180), sizes,
                   gen::resize(rc::kNominalSize, gen::inRange(0, 9))));
}

/// Boolean trees of at most this depth.
inline Gen<SolidPtr> tree(int depth)
{
    if (depth == 0) return primitive();
    const auto part = tree(depth - 1);
    const auto both = [](SolidPtr a, SolidPtr b) { return solid(scene::Intersection{{std::move(a), std::move(b)}}); };
    const auto either = [](SolidPtr a, SolidPtr b) { return solid(scene::Union{{std::move(a), std::move(b)}}); };
    return gen::shrink(gen::oneOf(part, gen::map(part, [](SolidPtr of) { return complement(std::move(of)); }),
                                  gen::apply(both, part, part), gen::apply(either, part, part),
                                  node<scene::Difference>(part, part)),
                       [](const SolidPtr& s) { return rc::seq::fromContainer(parts_of(s)); });
}

inline Gen<Body> body(int depth)
{
    return gen::map(tree(depth), [](SolidPtr s) { return Body{std::move(s)}; });
}

/// From up to 2^10 units away, or from within, to a place among the solids.
inline Gen<Beam> beam()
{
    const auto make = [](Vec3 from, double distance, Vec3 to) {
        const Vec3 o = to_real<Float>(from * distance);
        const Vec3 away = to - o;
        return Beam{o, to_real<Float>(scene::unit(scene::length(away) < 1e-3 ? Vec3{0, 0, 1} : away))};
    };
    const auto distance = gen::map(whole(10), [](int k) { return k < 0 ? 1.0 : std::exp2(k); });
    return gen::apply(make, arrow(), distance, gen::map(place(), [](Vec3 v) { return v * 1.01; }));
}

inline Gen<Rgb> filter()
{
    const auto part = gen::map(gen::inRange(0, 65), [](int k) { return k / 64.0; });
    return gen::apply([](double r, double g, double b) { return Rgb{r, g, b}; }, part, part, part);
}

inline Gen<Optics> optics()
{
    const auto make = [](Rgb reflection, Rgb absorption, Rgb refraction, Rgb passthrough, int index, bool fresnel) {
        Optics o;
        o.reflection = reflection;
        o.absorption = absorption;
        o.refraction = refraction;
        o.passthrough = passthrough;
        o.index = index < -16 ? -1 : index < 0 ? 0 : 1 + index / 16.0;
        o.fresnel = fresnel;
        return o;
    };
    return gen::apply(make, filter(), filter(), filter(), filter(), whole(20), gen::arbitrary<bool>());
}

/// Whole scenes: solids with optics of their own, lights, sky, settings and observer.
inline Gen<Scene> scene()
{
    const auto make = [](const std::vector<std::pair<SolidPtr, Optics>>& objects, const std::vector<Vec3>& lights,
                         Rgb sky, Vec3 eye, int hops, int law) {
        Scene s = empty_scene();
        s.observer = scene::Pinhole{eye + Vec3{0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 45};
        s.sky = scene::SkyColor{sky};
        s.settings.max_hops = static_cast<unsigned>(20 + hops);
        s.settings.light_law = law < 0   ? scene::LightLaw::lambert
                               : law > 0 ? scene::LightLaw::inverse_square
                                         : scene::LightLaw::paper;
        for (const auto& [solid, optics] : objects) add(s, solid, optics);
        for (const Vec3& point : lights) s.lights.push_back({point * 4, {1, .5, .25}, {}});
        return s;
    };
    return gen::apply(make, gen::container<std::vector<std::pair<SolidPtr, Optics>>>(gen::pair(tree(2), optics())),
                      gen::container<std::vector<Vec3>>(place()), filter(), place(), whole(19), whole(1));
}

} // namespace generate
} // namespace clucida::test
