// The torus: up to four crossings of a line, tangents, and rays that leave it.
#include "native_oracle.h"

namespace clucida::test {
namespace {

template <typename P>
class KernelsTorus : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsTorus, Machines, MachineNames);

SolidPtr torus(double major, double minor, Vec3 axis = {0, 0, 1})
{
    return solid(scene::Torus{{0, 0, 0}, axis, major, minor});
}

/// The places of all surfaces on the way straight through.
template <typename P>
std::vector<Hit> walk(const Native& scene, Vec3 o, Vec3 d, bool inside, Stats& stats)
{
    std::vector<Hit> hits;
    Path path{o, d};
    while (hits.size() < 20) {
        const auto hit = next_hit<P>(scene, path, std::vector<u32>(inside ? 1 : 0, 0U), stats);
        if (!hit) break;
        hits.push_back(*hit);
        inside = !inside;
        path = beyond(*hit, d);
    }
    return hits;
}

TYPED_TEST(KernelsTorus, ALineThroughTheMiddleCrossesItFourTimes)
{
    using P = TypeParam;
    Stats stats{};
    for (const bool inverse : {false, true}) {
        const SolidPtr ring = torus(1, .25);
        const Native scene(scene_of({inverse ? complement(ring) : ring}));
        for (const double from : {-2.0, -100.0, -1e6}) {
            const auto hits = walk<P>(scene, {from, 0, 0}, {1, 0, 0}, inverse, stats);
            ASSERT_EQ(hits.size(), 4U) << from;
            const double expected[] = {-1.25, -.75, .75, 1.25};
            for (std::size_t i = 0; i < 4; i++) {
                EXPECT_NEAR(hits[i].p.x, expected[i], 4 * P::u);
                EXPECT_NEAR(std::fabs(hits[i].n.x), 1, 2 * P::u);
                EXPECT_EQ(hits[i].n.x > 0, (i % 2 == 1) != inverse) << i;
            }
        }
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsTorus, ALineAlongItsAxisOrParallelToItIsMetWhereItMust)
{
    using P = TypeParam;
    Stats stats{};
    const Native scene(scene_of({torus(1, .25)}));
    for (const double from : {-2.0, -1e4}) {
        EXPECT_TRUE(walk<P>(scene, {0, 0, from}, {0, 0, 1}, false, stats).empty()); // through the hole
        EXPECT_TRUE(walk<P>(scene, {1.5, 0, from}, {0, 0, 1}, false, stats).empty());
        const auto hits = walk<P>(scene, {0, -1.125, from}, {0, 0, 1}, false, stats);
        ASSERT_EQ(hits.size(), 2U);
        const double height = std::sqrt(.0625 - .125 * .125);
        EXPECT_NEAR(hits[0].p.z, -height, 8 * P::u);
        EXPECT_NEAR(hits[1].p.z, height, 8 * P::u);
    }
    // A line that crosses the axis, and lines that pass it by ever less.
    for (double aside = .1; aside > 1e-30; aside /= 10) {
        for (const double y : {0.0, to_real<P>(aside)}) {
            const Vec3 d = to_real<P>(scene::unit({3, 0, .25}));
            const auto hits = walk<P>(scene, {-3, y, -.25}, d, false, stats);
            EXPECT_EQ(hits.size(), 4U) << y;
        }
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsTorus, ATangentOfTheInnerEquatorIsJudgedRightBeyondFourUnits)
{
    using P = TypeParam;
    Stats stats{};
    const Native scene(scene_of({torus(1, .25)}));
    for (const double from : {-2.0, -50.0}) {
        for (int k = -64; k <= 64; k++) {
            const double y = .75 * (1 + k * 2 * P::u);
            const auto hits = walk<P>(scene, {from, y, 0}, {1, 0, 0}, false, stats);
            if (k < -4) {
                EXPECT_EQ(hits.size(), 4U) << k << " units nearer to the axis";
            }
            if (k > 4) {
                EXPECT_EQ(hits.size(), 2U) << k << " units within the ring";
            }
            ASSERT_GE(hits.size(), 2U);
            EXPECT_EQ(hits.size() % 2, 0U);
            const double x = std::sqrt((1.25 - y) * (1.25 + y));
            EXPECT_NEAR(hits[0].p.x, -x, 16 * P::u);
            EXPECT_NEAR(hits.back().p.x, x, 16 * P::u);
        }
        for (int k = -64; k <= 64; k++) { // the outer equator, and the plane on which it lies
            const double far = 1.25 * (1 + k * 2 * P::u), high = .25 * (1 + k * 2 * P::u);
            const auto outer = walk<P>(scene, {from, far, 0}, {1, 0, 0}, false, stats);
            const auto top = walk<P>(scene, {from, 0, high}, {1, 0, 0}, false, stats);
            if (k < -4) {
                EXPECT_EQ(outer.size(), 2U) << k;
            }
            if (k > 4) {
                EXPECT_EQ(outer.size(), 0U) << k;
            }
            if (k < -16) {
                EXPECT_EQ(top.size(), 4U) << k;
            } // a unit of .25 is a quarter of one of the ring
            if (k > 16) {
                EXPECT_EQ(top.size(), 0U) << k;
            }
        }
    }
    expect_sound(stats);
}

/// A surface point and a ray from it at a given cosine with the normal, outwards if that is above 0.
template <typename P>
struct Departure {
    Hit hit;
    Vec3 d;
};
template <typename P>
std::optional<Departure<P>> random_departure(const Native& scene, const LayoutTorus& torus, Random& random,
                                             double cosine, Stats& stats)
{
    const Vec3 o = to_real<P>(random_direction(random) * 3);
    const Vec3 axis{torus.axis[0], torus.axis[1], torus.axis[2]}, aside = random_direction(random);
    const Vec3 target = scene::unit(aside - axis * scene::dot(axis, aside)) * torus.major;
    const auto hit = next_hit<P>(scene, {o, scene::unit(target - o)}, {}, stats);
    if (!hit) return std::nullopt;
    const Vec3 side = scene::unit(scene::cross(hit->n, random_direction(random)));
    const auto d = exact_direction<P>(hit->n * cosine + side * std::sqrt(1 - cosine * cosine));
    if (!d) return std::nullopt;
    return Departure<P>{*hit, *d};
}

template <typename P>
void check_departures(double minor, unsigned rays)
{
    using W = typename P::Wide;
    const Native scene(scene_of({torus(1 - minor, minor, {.3, -.2, .9})}));
    const Leaf<W> leaf = leaf_of<W>(scene, 0);
    Random random(31);
    Stats stats{};
    unsigned wrong = 0, hits = 0, misses = 0;
    double worst = 0;
    if (sizeof(typename P::real) == 8) rays /= 8; // Wide is slow beside it
    rays /= P::share;
    for (unsigned i = 0; i < rays; i++) {
        const double cosine = log_uniform(random, 1e-4, 1) * (random() % 2 == 0 ? 1 : -1);
        const auto start = random_departure<P>(scene, scene.items<LayoutTorus>(BUFFER_TORI)[0], random, cosine, stats);
        if (!start) continue;
        // The torus through the very point, so that one root is 0.
        Primitive<W> ring = leaf.members[0];
        const Wide3<W> o = widen<W>(start->hit.p), d = widen<W>(start->d);
        ring.minor += ring.value(o);
        std::vector<Root<W>> roots;
        const bool inward = dot(ring.gradient(o), d) < 0;
        // A gap thinner than what coordinates are stored to may be passed over, in double too.
        if (!ring.append_roots(o, d, 16 * W(Float::u), roots) || roots.empty()) continue;
        std::erase_if(roots, [](const auto& r) { return r.t < W(1e-10L); });
        std::ranges::sort(roots, [](const auto& a, const auto& b) { return a.t < b.t; });
        const Path path{start->hit.p, start->d, start->hit.left, inward};
        const auto next = next_hit<P>(scene, path, std::vector<u32>(inward ? 1 : 0, 0U), stats);
        if (next.has_value() != !roots.empty()) {
            if (wrong++ < 3) ADD_FAILURE() << (next ? "met itself" : "missed itself") << " at a cosine of " << cosine;
            continue;
        }
        (next ? hits : misses)++;
        if (!next) continue;
        const Wide3<W> at = along(o, d, roots[0].t), p = widen<W>(next->p);
        const Wide3<W> off{p[0] - at[0], p[1] - at[1], p[2] - at[2]};
        const double error = static_cast<double>(root(dot(off, off)) / roots[0].slope / W(P::u));
        EXPECT_TRUE(error < 1e5) << "at a cosine of " << cosine << ": " << next->t << " for "
                                 << static_cast<double>(roots[0].t) << (inward ? " in" : " out");
        worst = std::max(worst, error);
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_LE(worst, 16) << "units of error x cos";
    EXPECT_GT(hits, rays / 12);
    EXPECT_GT(misses, rays / 12);
    expect_sound(stats);
}

TYPED_TEST(KernelsTorus, ARayThatLeavesItMeetsItAgainWhereItMustAndNowhereElse)
{
    check_departures<TypeParam>(.25, 100000);
    check_departures<TypeParam>(.484375, 20000);
    check_departures<TypeParam>(.03125, 20000);
}

TYPED_TEST(KernelsTorus, AChordOfLessThanRoundingIsWalkedAllTheSame)
{
    using P = TypeParam;
    // Found by many_rays: within rounding of the surface it goes inward, nearly along the tangent.
    const Vec3 center{1.2744375958193528, -1.9644351409902807, 2.055646787141902};
    const Vec3 axis{0.06538896804469971, 0.9820905892456595, -0.17669849284349518};
    const Vec3 o{0x1.c684dcp+1, -0x1.8a0a48p+1, -0x1.0e4fbcp+2}, d{0x1.83ee82p-1, 0x1.2b3ee6p-7, 0x1.4e1cccp-1};
    const SolidPtr ring = solid(scene::Torus{center, axis, 6.796076661791698, 0.16648340263539915});
    for (const bool inverse : {false, true}) {
        const Native scene(scene_of({inverse ? complement(ring) : ring}));
        Stats stats{};
        const Path path{o, d, scene.items<u32>(BUFFER_MEMBERS)[0] & ~MEMBER_INVERSE, true};
        const auto hit = next_hit<P>(scene, path, std::vector<u32>(inverse ? 0 : 1, 0U), stats);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->beyond_inside, false);
        EXPECT_LT(hit->t, .01);
        expect_sound(stats);
    }
}

TYPED_TEST(KernelsTorus, LightThatRunsWithinAGlassRingNeverLeaksOut)
{
    using P = TypeParam;
    // Total reflections along a ring, as in an optical fibre.
    const Native scene(scene_of({torus(1, .125)}));
    Random random(5);
    Stats stats{};
    for (int i = 0; i < 50 / P::share; i++) {
        const Vec3 o{1 + uniform(random, -.05, .05), 0, uniform(random, -.05, .05)};
        Path path{to_real<P>(o), to_real<P>(scene::unit({uniform(random, -.1, .1), 1, uniform(random, -.1, .1)})),
                  MEMBER_NONE, false};
        for (int k = 0; k < 500; k++) {
            const auto hit = next_hit<P>(scene, path, {0U}, stats);
            ASSERT_TRUE(hit) << "escaped after " << k << " reflections";
            ASSERT_EQ(hit->after, vacuum);
            const double across = std::hypot(hit->p.x, hit->p.y) - 1;
            ASSERT_NEAR(std::hypot(across, hit->p.z), .125, 8 * P::u);
            path = back(*hit, mirrored<P>(path.d, hit->n));
        }
    }
    expect_sound(stats);
}

} // namespace
} // namespace clucida::test
