// Boolean trees and overlapping objects: the surfaces along a ray against membership between all crossings.
#include "native_oracle.h"

#include "scene/write.h"

#include <functional>

namespace clucida::test {
namespace {

template <typename P>
class KernelsBooleans : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsBooleans, Machines, MachineNames);

using W = long double;
using Point = Wide3<W>;

/// A random tree: the solid, and whether a point lies in it by the leaves' own values.
struct Tree {
    SolidPtr solid;
    std::function<bool(const Point&)> holds;
};

struct Pool {
    std::vector<SolidPtr> solids;
    std::vector<Leaf<W>> leaves;
};

SolidPtr random_primitive(Random& random)
{
    const Vec3 c = random_in_box(random, 1), axis = random_direction(random) * uniform(random, .4, 1.2);
    const double size = uniform(random, .5, 1.5);
    switch (random() % 12) {
    case 0: return plane(c, axis);
    case 1: return solid(scene::Cylinder{c, axis});
    case 2: return solid(scene::Cone{c, axis});
    case 3: return solid(scene::Paraboloid{c, axis * .5});
    case 4: return solid(scene::Hyperboloid{c, axis, size * .5});
    case 5: return solid(scene::Saddle{c, axis, random_direction(random)});
    case 6: return solid(scene::Cuboid{c, axis, random_direction(random), {size, 1.5 * size, .7 * size}});
    case 7: return solid(scene::Transformed{scene::Scale{{size, 1, .6}}, sphere(c, 1)});
    case 8: return solid(scene::Torus{c, axis, size, size * uniform(random, .2, .9)});
    case 9: { // a hyperboloid of two sheets
        const Vec3 s{1 / size, 1, -1.5};
        return solid(scene::FreeQuadric{{s.x, s.y, s.z, .1, -.2, .1, c.x, c.y, c.z, .25 * size}});
    }
    default: return sphere(c, size);
    }
}

Pool random_pool(Random& random)
{
    Pool pool;
    const std::size_t count = 2 + random() % 4;
    for (std::size_t i = 0; i < count; i++) {
        pool.solids.push_back(random_primitive(random));
        // Each alone in a scene: its numbers as the buffers hold them.
        pool.leaves.push_back(leaf_of<W>(Native(scene_of({pool.solids.back()})), 0));
    }
    return pool;
}

Tree random_tree(Random& random, const Pool& pool, int depth)
{
    const auto kind = depth == 0 ? 0 : random() % 6;
    if (kind < 1) {
        const std::size_t i = random() % pool.solids.size();
        return {pool.solids[i], [&pool, i](const Point& p) { return pool.leaves[i].holds(p); }};
    }
    const Tree a = random_tree(random, pool, depth - 1);
    if (kind == 1) return {complement(a.solid), [a](const Point& p) { return !a.holds(p); }};
    const Tree b = random_tree(random, pool, depth - 1);
    if (kind < 4)
        return {solid(scene::Intersection{{a.solid, b.solid}}),
                [a, b](const Point& p) { return a.holds(p) && b.holds(p); }};
    if (kind == 4)
        return {solid(scene::Union{{a.solid, b.solid}}), [a, b](const Point& p) { return a.holds(p) || b.holds(p); }};
    return {solid(scene::Difference{a.solid, b.solid}), [a, b](const Point& p) { return a.holds(p) && !b.holds(p); }};
}

struct Event {
    W t, slope;
    u32 before, after;
    std::vector<u32> inside_after;
};

std::vector<u32> holders(const std::vector<Tree>& trees, const Point& p)
{
    std::vector<u32> ids;
    for (u32 i = 0; i < trees.size(); i++)
        if (trees[i].holds(p)) ids.push_back(i);
    return ids;
}

u32 medium(const std::vector<u32>& inside)
{
    return inside.empty() ? vacuum : inside[0];
}

/// Positions of some units, rounded to float in the buffers and once a surface: 32 units in the last place.
constexpr W position_blur = 32 * 0x1p-24L * 8;

/// What a ray must meet; nothing if crossings lie so close, so far or so flat that rounding may decide.
std::optional<std::vector<Event>> expected_events(const std::vector<Pool>& pools, const std::vector<Tree>& trees,
                                                  const Point& o, const Point& d, std::vector<u32>& start)
{
    std::vector<Root<W>> roots;
    for (const Pool& pool : pools)
        for (const Leaf<W>& leaf : pool.leaves)
            for (const Primitive<W>& member : leaf.members)
                if (!member.append_roots(o, d, 1e-4L, roots)) return std::nullopt;
    std::ranges::sort(roots, [](const auto& a, const auto& b) { return a.t < b.t; });
    W last = -1e9L, last_slope = 1;
    for (const Root<W>& r : roots) {
        const W blur = position_blur * (r.slope + last_slope);
        if (r.t - last < blur || magnitude(r.t) < blur || magnitude(r.t) > 30) return std::nullopt;
        last = r.t;
        last_slope = r.slope;
    }
    start = holders(trees, o);
    std::vector<u32> inside = start;
    std::vector<Event> events;
    for (std::size_t k = 0; k < roots.size(); k++) {
        if (roots[k].t < 0) continue;
        const W after = k + 1 < roots.size() ? (roots[k].t + roots[k + 1].t) / 2 : roots[k].t + 1;
        std::vector<u32> next = holders(trees, along(o, d, after));
        if (medium(next) != medium(inside))
            events.push_back({roots[k].t, roots[k].slope, medium(inside), medium(next), next});
        inside = std::move(next);
    }
    return events;
}

/// Goes straight through all surfaces; says what differs from the expected events, or nothing.
template <typename P>
std::string difference(const Native& scene, Vec3 o, Vec3 d, std::vector<u32> inside, const std::vector<Event>& events,
                       Stats& stats)
{
    Path path{o, d};
    for (std::size_t k = 0; k <= events.size(); k++) {
        const std::optional<Hit> hit = next_hit<P>(scene, path, inside, stats);
        if (k == events.size()) return hit ? "one surface more at t = " + std::to_string(hit->t) : "";
        const std::string which = "surface " + std::to_string(k) + " of " + std::to_string(events.size()) +
                                  " at t = " + std::to_string(static_cast<double>(events[k].t));
        if (!hit) return which + " is missing";
        if (hit->before != events[k].before || hit->after != events[k].after)
            return which + " has the wrong media: " + std::to_string(static_cast<int>(hit->before)) + " to " +
                   std::to_string(static_cast<int>(hit->after)) + " at " + std::to_string(scene::dot(hit->p - o, d));
        if (magnitude(scene::dot(hit->p - o, d) - events[k].t) > position_blur * events[k].slope)
            return which + " is met at " + std::to_string(scene::dot(hit->p - o, d));
        inside = events[k].inside_after;
        path = beyond(*hit, d);
    }
    return "";
}

struct Tally {
    unsigned rays = 0, unsure = 0, events = 0, wrong = 0;
};

template <typename P>
void check_trees(Random& random, std::size_t objects, bool shared, int depth, unsigned rays, Tally& tally, Stats& stats)
{
    std::vector<Pool> pools;
    for (std::size_t i = 0; i < (shared ? 1 : objects); i++) pools.push_back(random_pool(random));
    std::vector<Tree> trees;
    std::vector<SolidPtr> solids;
    for (std::size_t i = 0; i < objects; i++) {
        trees.push_back(random_tree(random, pools[shared ? 0 : i], depth));
        solids.push_back(trees.back().solid);
    }
    const Scene scene = scene_of(solids);
    const Native native(scene);
    for (unsigned i = 0; i < rays; i++) {
        const Vec3 o = to_real<Float>(random_direction(random) * uniform(random, 5, 8));
        const std::optional<Vec3> d = exact_direction<P>(random_in_box(random, 1.5) - o);
        if (!d) continue;
        std::vector<u32> start;
        const auto events = expected_events(pools, trees, widen<W>(o), widen<W>(*d), start);
        if (!events) {
            tally.unsure++;
            continue;
        }
        tally.rays++;
        tally.events += static_cast<unsigned>(events->size());
        const std::string wrong = difference<P>(native, o, *d, start, *events, stats);
        if (!wrong.empty() && tally.wrong++ < 3)
            ADD_FAILURE() << wrong << std::hexfloat << "\nfrom " << o.x << ' ' << o.y << ' ' << o.z << " along " << d->x
                          << ' ' << d->y << ' ' << d->z << '\n'
                          << scene::print_scene(scene);
    }
}

void expect_right(const Tally& tally, const Stats& stats)
{
    EXPECT_EQ(tally.wrong, 0U) << "of " << tally.rays << " rays, " << tally.events << " events";
    EXPECT_LT(tally.unsure, tally.rays);
    EXPECT_GT(tally.events, tally.rays / 2);
    expect_sound(stats);
}

TYPED_TEST(KernelsBooleans, RandomTreesHaveTheirBoundariesWhereMembershipChanges)
{
    Random random(1);
    Tally tally;
    Stats stats{};
    for (int i = 0; i < 400 / TypeParam::share; i++)
        check_trees<TypeParam>(random, 1, true, 1 + i % 4, 100, tally, stats);
    expect_right(tally, stats);
}

TYPED_TEST(KernelsBooleans, WhereRandomObjectsOverlapTheFirstIsTheMedium)
{
    Random random(2);
    Tally tally;
    Stats stats{};
    for (int i = 0; i < 400 / TypeParam::share; i++)
        check_trees<TypeParam>(random, 2 + i % 2, false, i % 3, 50, tally, stats);
    expect_right(tally, stats);
}

/// A primitive that two objects share is stored relative to each object's centre: the roundings differ.
TYPED_TEST(KernelsBooleans, ObjectsThatShareBoundariesCrossThemAsOne)
{
    Random random(6);
    Tally tally;
    Stats stats{};
    for (int i = 0; i < 4000 / TypeParam::share; i++)
        check_trees<TypeParam>(random, 2 + i % 3, true, i % 3, 50, tally, stats);
    expect_right(tally, stats);
}

TYPED_TEST(KernelsBooleans, ABoundaryFarAheadAtASlantIsNotCrossedWithTheNearOne)
{
    using P = TypeParam;
    const SolidPtr block = solid(scene::Cuboid{{0, 0, 2}, {0, 0, 1}, {1, 0, 0}, {1, 1, 1}});
    const SolidPtr floor = solid(scene::Plane{{0, 0, 0}, {0, 0, 1}});
    const Native native(scene_of({block, floor}));
    Stats stats{};
    for (const double fall : {1e-3, 1e-5, 1e-6, 1e-7}) {
        const Vec3 d = scene::unit(Vec3{1, 0, -fall});
        Path path{{-3, 0, 2}, d};
        const std::optional<Hit> in = next_hit<P>(native, path, {}, stats);
        ASSERT_TRUE(in && in->after == 0) << fall;
        const std::optional<Hit> out = next_hit<P>(native, beyond(*in, d), {0U}, stats);
        ASSERT_TRUE(out.has_value()) << fall;
        EXPECT_EQ(out->after, vacuum) << "the floor is two units below, at a fall of " << fall;
    }
    expect_sound(stats);
}

/// All surfaces along the same random rays, as bytes.
template <typename P>
std::vector<double> events_of(const SolidPtr& solid)
{
    const Native native(scene_of({solid}));
    Random random(3);
    std::vector<double> all;
    Stats stats{};
    for (int i = 0; i < 2000 / P::share; i++) {
        const Vec3 o = random_direction(random) * 6, d = scene::unit(random_in_box(random, 1.2) - o);
        Path path{o, d};
        std::vector<u32> inside;
        while (const std::optional<Hit> hit = next_hit<P>(native, path, inside, stats)) {
            for (const double v : {hit->t, hit->p.x, hit->p.y, hit->p.z, hit->n.x, hit->n.y, hit->n.z})
                all.push_back(v);
            inside.assign(inside.empty() ? 1 : 0, 0U);
            path = beyond(*hit, d);
        }
        all.push_back(-1);
    }
    expect_sound(stats);
    return all;
}

TYPED_TEST(KernelsBooleans, TheSameSetWrittenInAnotherWayHasTheSameEventsBitForBit)
{
    using P = TypeParam;
    // Both bounded and with a spherical bound of one and the same kind.
    const SolidPtr a = sphere({0, 0, 0}, 1), b = sphere({.5, .25, 0}, .75);
    const auto both = [](SolidPtr x, SolidPtr y) { return solid(scene::Intersection{{x, y}}); };
    const auto either = [](SolidPtr x, SolidPtr y) { return solid(scene::Union{{x, y}}); };
    const auto minus = [](SolidPtr x, SolidPtr y) { return solid(scene::Difference{x, y}); };
    EXPECT_EQ(events_of<P>(a), events_of<P>(both(a, a)));
    EXPECT_EQ(events_of<P>(a), events_of<P>(both(a, sphere({0, 0, 0}, 1))));
    EXPECT_EQ(events_of<P>(a), events_of<P>(either(a, a)));
    EXPECT_EQ(events_of<P>(a), events_of<P>(complement(complement(a))));
    EXPECT_EQ(events_of<P>(minus(a, b)), events_of<P>(both(a, complement(b))));
    EXPECT_EQ(events_of<P>(both(a, b)), events_of<P>(complement(either(complement(a), complement(b)))));
    EXPECT_EQ(events_of<P>(either(a, b)), events_of<P>(complement(both(complement(a), complement(b)))));
    EXPECT_GT(events_of<P>(minus(a, b)).size(), 10000U / P::share);
}

/// The t of each surface on the way straight through, and the media.
template <typename P>
std::vector<Hit> walk(const Native& scene, Vec3 o, Vec3 d, std::vector<u32> inside, Stats& stats)
{
    std::vector<Hit> hits;
    Path path{o, d};
    while (hits.size() < 100) {
        const auto hit = next_hit<P>(scene, path, inside, stats);
        if (!hit) break;
        hits.push_back(*hit);
        std::erase(inside, hit->before);
        if (hit->after != vacuum && std::ranges::find(inside, hit->after) == inside.end())
            inside.insert(std::ranges::lower_bound(inside, hit->after), hit->after);
        path = beyond(*hit, d);
    }
    return hits;
}

TYPED_TEST(KernelsBooleans, ConcentricShellsAreCrossedInOrder)
{
    using P = TypeParam;
    for (const double gap : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        std::vector<SolidPtr> shells;
        for (int k = 5; k >= 0; k--) shells.push_back(sphere({0, 0, 0}, 1 - k * gap)); // the innermost first
        const Native scene(scene_of(shells));
        Random random(4);
        Stats stats{};
        unsigned wrong = 0;
        for (int i = 0; i < 5000 / TypeParam::share; i++) {
            const Vec3 o = random_direction(random) * 2;
            const Vec3 d = scene::unit(random_in_box(random, .5) - o);
            std::vector<u32> inside;
            Path path{o, d};
            bool right = true;
            for (int k = 0; k < 12; k++) {
                const auto hit = next_hit<P>(scene, path, inside, stats);
                const u32 shell = k < 6 ? static_cast<u32>(5 - k) : static_cast<u32>(k - 6);
                right = right && hit && (k < 6 ? hit->after : hit->before) == shell;
                if (!right) break;
                if (k < 6)
                    inside.insert(inside.begin(), shell);
                else
                    inside.erase(inside.begin());
                path = beyond(*hit, d);
            }
            right = right && !next_hit<P>(scene, path, inside, stats);
            wrong += right ? 0 : 1;
        }
        EXPECT_EQ(wrong, 0U) << "rays at a relative gap of " << gap;
        expect_sound(stats);
    }
}

TYPED_TEST(KernelsBooleans, ADifferenceWithFlushFacesLeavesNoFilm)
{
    // B is cut out of A up to A's own face, at places that floats do not hold.
    for (const double at : {0.1, 0.3, 1.7, 123.4}) {
        const SolidPtr a = cuboid({at, 0, 0}, {1, 1, 1}), b = cuboid({at, 0, .3}, {.6, .6, .4});
        const Native scene(scene_of({solid(scene::Difference{a, b})}));
        Random random(5);
        Stats stats{};
        for (int i = 0; i < 5000 / TypeParam::share; i++) {
            const Vec3 target{at + uniform(random, -.25, .25), uniform(random, -.25, .25), .5};
            const Vec3 d = scene::unit({uniform(random, -.02, .02), uniform(random, -.02, .02), -1});
            const auto hits = walk<TypeParam>(scene, target - d * 3, d, {}, stats);
            ASSERT_EQ(hits.size(), 2U) << "at " << at;
            EXPECT_NEAR(hits[0].p.z, .1, 1e-5);
            EXPECT_NEAR(hits[1].p.z, -.5, 1e-5);
        }
        expect_sound(stats);
    }
}

TYPED_TEST(KernelsBooleans, ARayThroughTheContactOfTangentSpheresCrossesBoth)
{
    Stats stats{};
    const Native scene(scene_of({sphere({0, 0, 0}, 1), sphere({2, 0, 0}, 1)}));
    const auto hits = walk<TypeParam>(scene, {-3, 0, 0}, {1, 0, 0}, {}, stats);
    ASSERT_EQ(hits.size(), 3U); // the contact is one interface, from the one into the other
    EXPECT_EQ(hits[1].before, 0U);
    EXPECT_EQ(hits[1].after, 1U);
    EXPECT_EQ(hits[1].p.x, 1);
    EXPECT_EQ(hits[2].p.x, 3);
    const auto past = walk<TypeParam>(scene, {1, -3, 0}, {0, 1, 0}, {}, stats); // between them
    EXPECT_TRUE(past.empty());
    expect_sound(stats);
}

} // namespace
} // namespace clucida::test
