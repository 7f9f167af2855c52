// Every primitive alone: where random rays meet it, near and far, from outside and inside.
#include "native_oracle.h"

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
    const W steep = root(dot(g, g)) * (leaf.inverse ? -1 : 1);
    const Wide3<W> turned{n[0] - g[0] / steep, n[1] - g[1] / steep, n[2] - g[2] / steep};
    // A gradient that fades, as at a cone's apex, knows its direction less well.
    const double normal =
        static_cast<double>(root(dot(turned, turned)) * std::min<W>(1, magnitude(steep) / size) / W(P::u));
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
void check_primitive(const SolidPtr& solid, unsigned rays)
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
    EXPECT_LE(worst.error, 8) << "units of error x cos, wrong from a distance of " << worst.error_from << " on";
    EXPECT_LE(worst.normal, 16) << "units of the normal's direction, from " << worst.normal_from << " on";
    EXPECT_LE(worst.length, 2) << "units of the normal's length";
    EXPECT_EQ(worst.flips, 0U) << "from a distance of " << worst.flip_from << " on";
    EXPECT_EQ(worst.wrong_side, 0U);
    EXPECT_GT(worst.hits, rays / 8);
    EXPECT_LT(worst.unsure, rays / 200);
    expect_sound(stats);
    ::testing::Test::RecordProperty("worst_error_units", std::to_string(worst.error));
}

constexpr unsigned many = 200000, some = 30000;

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

TYPED_TEST(KernelsPrimitives, AComplementIsMetWhereItsPrimitiveIs)
{
    for (const SolidPtr& s :
         {plane({0, 0, .25}, {.6, 0, .8}), sphere({0, 0, 0}, 1), solid(scene::Cylinder{{0, 0, 0}, {.3, .4, .5}}),
          solid(scene::Cone{{0, 0, 0}, {.3, .9, -.6}}), solid(scene::Paraboloid{{0, 0, 0}, {.1, .2, .15}}),
          solid(scene::Hyperboloid{{0, 0, 0}, {.4, .3, 1}, .5}),
          solid(scene::Saddle{{0, 0, 0}, {.2, .1, .7}, {1, 0, .3}}), turned_cuboid(), ellipsoid()})
        check_primitive<TypeParam>(complement(s), some);
}

} // namespace
} // namespace clucida::test
