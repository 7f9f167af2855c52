// Every primitive alone: where random rays meet it, near and far, from outside and inside.
#include "native_oracle.h"
#include "quadric_of.h"

namespace clucida::test {
namespace {

template <typename P>
class KernelsPrimitives : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsPrimitives, Machines, MachineNames);

/// The event that must come first, or none; unsure where rounding may decide.
template <typename W>
struct Expected {
    bool unsure = false, inside = false, hit = false;
    W t = 0, slope = 1;
    std::size_t member = 0;
};

template <typename W>
Expected<W> expected(const Leaf<W>& leaf, const Wide3<W>& o, const Wide3<W>& d, W rounding)
{
    Expected<W> e;
    std::vector<std::pair<Root<W>, std::size_t>> roots;
    const W size = 1 + root(dot(o, o));
    for (std::size_t i = 0; i < leaf.members.size(); i++) {
        std::vector<Root<W>> own;
        const Wide3<W> g = leaf.members[i].gradient(o);
        e.unsure |= !leaf.members[i].append_roots(o, d, rounding, own);
        e.unsure |= magnitude(leaf.members[i].value(o)) <= rounding * size * root(dot(g, g));
        for (const Root<W>& r : own) roots.emplace_back(r, i);
    }
    std::ranges::sort(roots, [](const auto& a, const auto& b) { return a.first.t < b.first.t; });
    e.inside = leaf.holds(o);
    for (std::size_t k = 0; k < roots.size() && !e.hit; k++) {
        const auto& [r, member] = roots[k];
        if (!(r.t > 0)) continue;
        if (k > 0) e.unsure |= r.t - roots[k - 1].first.t <= rounding * (r.slope + roots[k - 1].first.slope);
        const W after = k + 1 < roots.size() ? (r.t + roots[k + 1].first.t) / 2 : r.t + 1;
        if (leaf.holds(along(o, d, after)) != e.inside) {
            e.hit = true;
            e.t = r.t;
            e.slope = r.slope;
            e.member = member;
        }
    }
    return e;
}

struct Worst {
    double error = 0, normal = 0, length = 0;
    double error_from = 1e30, normal_from = 1e30, flip_from = 1e30; ///< the least distance of what is wrong
    unsigned hits = 0, misses = 0, unsure = 0, flips = 0, wrong_side = 0;
};

/// One ray: compares the core's first surface with the expected one.
template <typename P, typename W>
void compare(const std::optional<Hit>& hit, const Expected<W>& e, const Leaf<W>& leaf, const Path& path, Worst& worst)
{
    const Vec3 o = path.o, d = path.d;
    const Wide3<W> wo = widen<W>(o), wd = widen<W>(d);
    const double distance = clucida::scene::length(o);
    if (hit.has_value() != e.hit) {
        worst.flip_from = std::min(worst.flip_from, distance);
        if (worst.flips++ < 3)
            ADD_FAILURE() << (e.hit ? "missed" : "invented")
                          << " at t = " << static_cast<double>(e.hit ? e.t : W(hit->t)) << std::hexfloat << " from "
                          << o.x << ' ' << o.y << ' ' << o.z << " along " << d.x << ' ' << d.y << ' ' << d.z
                          << " inside " << e.inside;
        return;
    }
    (e.hit ? worst.hits : worst.misses)++;
    if (!e.hit) return;
    const Wide3<W> at = along(wo, wd, e.t), p = widen<W>(hit->p), n = widen<W>(hit->n);
    const Wide3<W> off{p[0] - at[0], p[1] - at[1], p[2] - at[2]};
    // A solid is as large as where it is met; the paper's solids without bounds have no other size.
    const W size = std::max<W>(1, root(dot(at, at)));
    const double error = static_cast<double>(root(dot(off, off)) / e.slope / (size * W(P::u)));
    Wide3<W> g = leaf.members[e.member].gradient(p);
    const W minor = leaf.members[e.member].minor;
    const W steep = root(dot(g, g)) * (leaf.inverse ? -1 : 1);
    const Wide3<W> turned{n[0] - g[0] / steep, n[1] - g[1] / steep, n[2] - g[2] / steep};
    // A gradient that fades, as at a cone's apex, knows its direction less well, and so does one that turns as fast as
    // a thin torus's.
    const double normal = static_cast<double>(root(dot(turned, turned)) * std::min<W>(1, magnitude(steep) / size) *
                                              (minor > 0 ? minor : W(1)) / W(P::u));
    if (error > 8) worst.error_from = std::min(worst.error_from, distance);
    if (normal > 16) worst.normal_from = std::min(worst.normal_from, distance);
    worst.error = std::max(worst.error, error);
    worst.normal = std::max(worst.normal, normal);
    worst.length = std::max(worst.length, static_cast<double>(magnitude(root(dot(n, n)) - 1) / W(P::u)));
    const u32 before = e.inside ? 0U : vacuum, after = e.inside ? vacuum : 0U;
    if (hit->before != before || hit->after != after || hit->object != 0 ||
        hit->beyond_inside != ((e.inside ? 0 : 1) != (leaf.inverse ? 1 : 0)))
        worst.wrong_side++;
}

template <typename P>
void check_primitive(const SolidPtr& solid, unsigned rays, double most = 8, unsigned least_hits = 0)
{
    using W = typename P::Wide;
    const Native scene(scene_of({solid}));
    const Leaf<W> leaf = leaf_of<W>(scene, 0);
    Random random(20160729);
    Worst worst;
    Stats stats{};
    if (std::is_same_v<typename P::real, double>) rays /= 8; // the expected values take 113 bits, in software
    std::vector<Query> queries;
    std::vector<Expected<W>> events;
    for (unsigned i = 0; i < rays; i++) {
        const Vec3 o = to_real<P>(random_direction(random) * log_uniform(random, 1e-2, 1e6));
        const std::optional<Vec3> d = exact_direction<P>(random_in_box(random, 1.25) - o);
        if (!d) {
            i--;
            continue;
        }
        const Expected<W> e = expected<W>(leaf, widen<W>(o), widen<W>(*d), 16 * W(P::u));
        if (e.unsure) {
            worst.unsure++;
            continue;
        }
        queries.push_back({{o, *d}, std::vector<u32>(e.inside ? 1 : 0, 0U)});
        events.push_back(e);
    }
    const Hits hits = P::surfaces(scene, queries, stats);
    for (std::size_t i = 0; i < hits.size(); i++) compare<P>(hits[i], events[i], leaf, queries[i].path, worst);
    EXPECT_LE(worst.error, most) << "units of error x cos, wrong from a distance of " << worst.error_from << " on";
    EXPECT_LE(worst.normal, 16) << "units of the normal's direction, from " << worst.normal_from << " on";
    EXPECT_LE(worst.length, 2) << "units of the normal's length";
    EXPECT_EQ(worst.flips, 0U) << "from a distance of " << worst.flip_from << " on";
    EXPECT_EQ(worst.wrong_side, 0U);
    EXPECT_GT(worst.hits, least_hits > 0 ? least_hits : rays / 8);
    EXPECT_LT(worst.unsure, rays / 200);
    expect_sound(stats);
    ::testing::Test::RecordProperty("worst_error_units", std::to_string(worst.error));
}

constexpr unsigned many = 200000, some = 30000;

SolidPtr torus(double minor)
{
    return solid(scene::Torus{{.0625, 0, -.03125}, {.3, -.2, .9}, 1 - minor, minor});
}

/// One of each kind, in a frame that is turned and moved. Written out: sum s X^2 + 2 sum l X + w.
struct Kind {
    const char* name;
    Vec3 s, l;
    double w;
};
constexpr Kind kinds[] = {{"ellipsoid", {1, 2, 4}, {}, -1},
                          {"one-sheet hyperboloid", {2, 1, -1}, {}, -.5},
                          {"two-sheet hyperboloid", {2, 1, -1.5}, {}, .25},
                          {"cone", {1, 2, -1}, {}, 0},
                          {"elliptic paraboloid", {1, 2, 0}, {0, 0, -1}, 0},
                          {"hyperbolic paraboloid", {1, -2, 0}, {0, 0, -1}, .125},
                          {"elliptic cylinder", {0, 2, 4}, {}, -1},
                          {"hyperbolic cylinder", {1, -.5, 0}, {}, .25},
                          {"parabolic cylinder", {0, 2, 0}, {1, 0, 0}, .125},
                          {"parallel planes", {0, 4, 0}, {}, -1},
                          {"half-space", {}, {.5, 0, 0}, -.25}};

constexpr Vec3 kind_center{.0625, -.125, .03125};
scene::Mat3 kind_frame()
{
    return scene::rotation({1, 2, 3}, 40);
}

SolidPtr quadric(const Kind& kind, double sign = 1)
{
    return quadric_of(kind_frame(), kind_center, kind.s * sign, kind.l * sign, kind.w * sign);
}
SolidPtr turned_cuboid()
{
    return solid(scene::Cuboid{{0, 0, 0}, {.3, -.2, .9}, {1, .4, 0}, {1, 1.5, .5}});
}
SolidPtr ellipsoid()
{
    return solid(scene::Transformed{scene::Rotate{{1, 2, 3}, 40},
                                    solid(scene::Transformed{scene::Scale{{1, .5, .75}}, sphere({0, 0, 0}, 1)})});
}

TYPED_TEST(KernelsPrimitives, APlaneIsMetWhereItIs)
{
    check_primitive<TypeParam>(plane({0, 0, .25}, {.6, 0, .8}), many);
}
TYPED_TEST(KernelsPrimitives, ASphereIsMetWhereItIs)
{
    check_primitive<TypeParam>(sphere({0, 0, 0}, 1), many);
}
TYPED_TEST(KernelsPrimitives, ASphereBesideTheEyeIsMetWhereItIs)
{
    // The centre is no 0, so that taking it from a far origin rounds.
    check_primitive<TypeParam>(sphere({.4375, -.3125, .1875}, 1), some);
}
TYPED_TEST(KernelsPrimitives, ACylinderIsMetWhereItIs)
{
    check_primitive<TypeParam>(solid(scene::Cylinder{{0, 0, 0}, {.3, .4, .5}}), many);
}
TYPED_TEST(KernelsPrimitives, AConeIsMetWhereItIs)
{
    check_primitive<TypeParam>(solid(scene::Cone{{0, 0, 0}, {.3, .9, -.6}}), many);
}
TYPED_TEST(KernelsPrimitives, AParaboloidIsMetWhereItIs)
{
    check_primitive<TypeParam>(solid(scene::Paraboloid{{0, 0, 0}, {.1, .2, .15}}), many);
}
TYPED_TEST(KernelsPrimitives, AHyperboloidIsMetWhereItIs)
{
    check_primitive<TypeParam>(solid(scene::Hyperboloid{{0, 0, 0}, {.4, .3, 1}, .5}), many);
}
TYPED_TEST(KernelsPrimitives, ASaddleIsMetWhereItIs)
{
    check_primitive<TypeParam>(solid(scene::Saddle{{0, 0, 0}, {.2, .1, .7}, {1, 0, .3}}), many);
}
TYPED_TEST(KernelsPrimitives, ACuboidIsMetWhereItIs)
{
    check_primitive<TypeParam>(turned_cuboid(), many);
}
TYPED_TEST(KernelsPrimitives, AnEllipsoidIsMetWhereItIs)
{
    check_primitive<TypeParam>(ellipsoid(), many);
}

TYPED_TEST(KernelsPrimitives, ATorusIsMetWhereItIs)
{
    check_primitive<TypeParam>(torus(.25), many, 16);
}
TYPED_TEST(KernelsPrimitives, AThickTorusIsMetWhereItIs)
{
    check_primitive<TypeParam>(torus(.484375), some, 16);
}
TYPED_TEST(KernelsPrimitives, AThinTorusIsMetWhereItIs)
{
    check_primitive<TypeParam>(torus(.03125), 2 * some, 16, 100); // few aim so well
}

TYPED_TEST(KernelsPrimitives, AFreeQuadricOfAnyKindIsMetWhereItIs)
{
    for (const Kind& kind : kinds) {
        SCOPED_TRACE(kind.name);
        check_primitive<TypeParam>(quadric(kind), some);
        check_primitive<TypeParam>(quadric(kind, -1), some);
    }
}

TYPED_TEST(KernelsPrimitives, AFreeQuadricOfTwoCrossingPlanesIsMetWhereItIs)
{
    using P = TypeParam;
    const Kind kind{"crossing planes", {1, 0, -2}, {}, 0};
    const Native scene(scene_of({quadric(kind)})), inverse(scene_of({quadric(kind, -1)}));
    Primitive<long double> q;
    q.c = widen<long double>(kind_center);
    q.s = widen<long double>(kind.s);
    for (int i = 0; i < 3; i++) q.m[i] = widen<long double>(kind_frame().rows[i]);
    Random random(8);
    Stats stats{};
    unsigned hits = 0;
    double worst = 0;
    for (int i = 0; i < 20000 / P::share; i++) {
        const Vec3 o = to_real<P>(random_direction(random) * log_uniform(random, 1e-2, 10));
        const Vec3 d = to_real<P>(scene::unit(random_in_box(random, 1.25) - o));
        const auto wo = widen<long double>(o), wd = widen<long double>(d);
        std::vector<Root<long double>> roots;
        // Near the edge a crossing of one plane may be taken for that of both.
        bool sure = q.append_roots(wo, wd, 1e-8L, roots);
        std::ranges::sort(roots, [](const auto& a, const auto& b) { return a.t < b.t; });
        for (std::size_t k = 0; k < roots.size(); k++)
            sure = sure && magnitude(roots[k].t) > 1e-5L * roots[k].slope &&
                   (k == 0 || roots[k].t - roots[k - 1].t > 1e-5L * (roots[k].slope + roots[k - 1].slope));
        if (!sure) continue;
        std::erase_if(roots, [](const auto& r) { return r.t < 0; });
        const bool inside = q.value(wo) < 0;
        for (const Native* s : {&scene, &inverse}) {
            std::vector<u32> in((s == &scene) == inside ? 1 : 0, 0U);
            Path path{o, d};
            for (const auto& r : roots) {
                const auto hit = next_hit<P>(*s, path, in, stats);
                ASSERT_TRUE(hit) << i;
                const auto at = along(wo, wd, r.t), p = widen<long double>(hit->p);
                const Wide3<long double> off{p[0] - at[0], p[1] - at[1], p[2] - at[2]};
                const long double size = std::max(1.0L, root(dot(at, at))) + root(dot(wo, wo));
                worst = std::max(worst, static_cast<double>(root(dot(off, off)) / r.slope / size / 0x1p-24L));
                in.assign(in.empty() ? 1 : 0, 0U);
                path = beyond(*hit, d);
                hits++;
            }
            ASSERT_FALSE(next_hit<P>(*s, path, in, stats)) << i;
        }
    }
    EXPECT_LE(worst, 8) << "float units: the planes are stored in it";
    EXPECT_GT(hits, 30000U / P::share);
    expect_sound(stats);
}

TYPED_TEST(KernelsPrimitives, AComplementIsMetWhereItsPrimitiveIs)
{
    for (const SolidPtr& s :
         {plane({0, 0, .25}, {.6, 0, .8}), sphere({0, 0, 0}, 1), solid(scene::Cylinder{{0, 0, 0}, {.3, .4, .5}}),
          solid(scene::Cone{{0, 0, 0}, {.3, .9, -.6}}), solid(scene::Paraboloid{{0, 0, 0}, {.1, .2, .15}}),
          solid(scene::Hyperboloid{{0, 0, 0}, {.4, .3, 1}, .5}),
          solid(scene::Saddle{{0, 0, 0}, {.2, .1, .7}, {1, 0, .3}}), turned_cuboid(), ellipsoid()})
        check_primitive<TypeParam>(complement(s), some);
    check_primitive<TypeParam>(complement(torus(.25)), some, 16);
}

} // namespace
} // namespace clucida::test
