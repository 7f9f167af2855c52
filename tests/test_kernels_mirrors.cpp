// Mirrors against closed forms, and rays along a surface: rulings, generators, axes, tangents.
#include "native_scene.h"

#include <algorithm>

namespace clucida::test {
namespace {

using scene::cross;
using scene::dot;
using scene::length;

template <typename P>
class KernelsMirrors : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsMirrors, Machines, MachineNames);

/// Rays that miss: the seen direction is the ray's own.
Scene mirrors(const std::vector<SolidPtr>& solids)
{
    Scene scene = empty_scene();
    scene.sky = scene::SkyRgb{};
    for (const SolidPtr& s : solids) add(scene, s, mirror());
    return scene;
}

/// How far the line from o along d (unit) passes by p.
double distance_to(Vec3 p, Vec3 o, Vec3 d)
{
    return length(cross(p - o, d));
}

TYPED_TEST(KernelsMirrors, AConcaveMirrorCrossesTheAxisWhereItMust)
{
    using P = TypeParam;
    Stats stats{};
    const Native bowl(mirrors({complement(sphere({0, 0, 0}, 1))}));
    const auto hit = next_hit<P>(bowl, {{0, to_real<P>(std::sin(.5)), 0}, {1, 0, 0}}, {}, stats);
    ASSERT_TRUE(hit);
    const Vec3 d = mirrored<P>({1, 0, 0}, hit->n);
    // The normal is off by some units, which the height of 0.48 turns into twice as much along the axis.
    EXPECT_NEAR(hit->p.x - hit->p.y * d.x / d.y, .569746963662274561, 16 * P::u);
    Measured("axis").see((hit->p.x - hit->p.y * d.x / d.y - .569746963662274561) / P::u);
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, AParabolicMirrorSendsParallelRaysThroughItsFocus)
{
    using P = TypeParam;
    Stats stats{};
    const Native dish(mirrors({complement(solid(scene::Paraboloid{{0, 0, 0}, {0, 0, .5}}))}));
    Random random(1);
    Measured worst("distance_from_focus");
    for (int i = 0; i < 1000 / P::share; i++) {
        const Vec3 o = to_real<P>(Vec3{uniform(random, -1, 1), uniform(random, -1, 1), 4});
        const auto hit = next_hit<P>(dish, {o, {0, 0, -1}}, {}, stats);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->p.z, (o.x * o.x + o.y * o.y) / 2, 4 * P::u);
        EXPECT_LE(distance_to({0, 0, .5}, hit->p, mirrored<P>({0, 0, -1}, hit->n)), 8 * P::u);
        worst.see(distance_to({0, 0, .5}, hit->p, mirrored<P>({0, 0, -1}, hit->n)) / P::u);
    }
    // Along the axis itself, and beside it without any mirror in the way.
    const auto apex = next_hit<P>(dish, {{0, 0, 4}, {0, 0, -1}}, {}, stats);
    ASSERT_TRUE(apex);
    EXPECT_EQ(apex->p, (Vec3{0, 0, 0}));
    EXPECT_FALSE(next_hit<P>(dish, {{.5, 0, 4}, {0, 0, 1}}, {}, stats));
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, AHyperbolicMirrorMapsOneFocusOntoTheOther)
{
    using P = TypeParam;
    Stats stats{};
    const double v = .5, h = 1, focus = std::sqrt(1.25); // sqrt(v^2 + h^2)
    const Native waist(mirrors({complement(solid(scene::Hyperboloid{{0, 0, 0}, {0, 0, h}, v}))}));
    Measured worst("distance_from_focus");
    for (double z = -2; z <= 2; z += .125) {
        const Vec3 o{0, 0, z};
        const auto d = scene::unit(Vec3{focus, 0, 0} - o);
        const auto hit = next_hit<P>(waist, {o, d}, {}, stats);
        ASSERT_TRUE(hit);
        EXPECT_LE(distance_to({-focus, 0, 0}, hit->p, mirrored<P>(d, hit->n)), 16 * P::u * (1 + std::fabs(z)));
        worst.see(distance_to({-focus, 0, 0}, hit->p, mirrored<P>(d, hit->n)) / (1 + std::fabs(z)) / P::u);
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, AHyperbolicMirrorOfTwoSheetsSendsWhatIsAimedAtOneFocusThroughTheOther)
{
    using P = TypeParam;
    Stats stats{};
    // (x^2 + y^2)/b^2 - z^2/a^2 < -1 with a = 1/2, b = 1: the foci are at z = +-sqrt(a^2 + b^2).
    const Native sheets(mirrors({solid(scene::FreeQuadric{{1, 1, -4, 0, 0, 0, 0, 0, 0, 1}})}));
    const double focus = to_real<P>(std::sqrt(1.25));
    const Vec3 behind{0, 0, focus}, before{0, 0, -focus};
    Random random(9);
    Measured worst("distance_from_focus");
    for (int i = 0; i < 1000; i++) {
        const Vec3 o = to_real<P>(Vec3{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -.375, .375)});
        const Vec3 d = to_real<P>(scene::unit(behind - o));
        const auto hit = next_hit<P>(sheets, {o, d}, {}, stats);
        ASSERT_TRUE(hit);
        EXPECT_GT(hit->p.z, .5 - 4 * P::u);
        EXPECT_LE(distance_to(before, hit->p, mirrored<P>(d, hit->n)), 32 * P::u);
        worst.see(distance_to(before, hit->p, mirrored<P>(d, hit->n)) / P::u);
        // Between the sheets the light goes back, and meets the other one, aimed at its focus.
        const Vec3 back_d = mirrored<P>(d, hit->n);
        const auto next = next_hit<P>(sheets, back(*hit, back_d), {}, stats);
        ASSERT_TRUE(next);
        EXPECT_LT(next->p.z, -.5 + 4 * P::u);
    }
    // From within a sheet: what comes from its focus seems to come from the other.
    for (int i = 0; i < 1000; i++) {
        const Vec3 d = to_real<P>(scene::unit({uniform(random, -1, 1), uniform(random, -1, 1), -1}));
        const auto hit = next_hit<P>(sheets, {behind, d}, {0U}, stats);
        ASSERT_TRUE(hit);
        EXPECT_LE(distance_to(before, hit->p, mirrored<P>(d, hit->n)), 32 * P::u * (1 + length(hit->p)));
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, ACornerCubeSendsRaysBackExactly)
{
    using P = TypeParam;
    const Native corner(
        mirrors({plane({0, 0, 0}, {1, 0, 0}), plane({0, 0, 0}, {0, 1, 0}), plane({0, 0, 0}, {0, 0, 1})}));
    const Native sky(mirrors({}));
    Random random(2);
    Stats stats{};
    for (int i = 0; i < 2000 / P::share; i++) {
        const Vec3 o{uniform(random, .5, 1), uniform(random, .5, 1), uniform(random, .5, 1)};
        const auto d = exact_direction<P>(random_in_box(random, .2) - o);
        if (!d || d->x > 0 || d->y > 0 || d->z > 0) continue;
        EXPECT_EQ(trace<P>(corner, to_real<P>(o), *d, stats), trace<P>(sky, o, -*d, stats));
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, ATurnedCornerCubeSendsRaysBack)
{
    using P = TypeParam;
    const scene::Mat3 turn = scene::rotation({1, 2, 3}, 37);
    const Vec3 x = turn * Vec3{1, 0, 0}, y = turn * Vec3{0, 1, 0}, z = turn * Vec3{0, 0, 1};
    const Native corner(mirrors({plane({0, 0, 0}, x), plane({0, 0, 0}, y), plane({0, 0, 0}, z)}));
    Random random(3);
    Stats stats{};
    Measured worst("direction_in_units_of_float");
    for (int i = 0; i < 2000 / P::share; i++) {
        const Vec3 o = turn * Vec3{uniform(random, .5, 1), uniform(random, .5, 1), uniform(random, .5, 1)};
        const Vec3 d = scene::unit(random_in_box(random, .2) - o);
        // The buffers' normals are floats, whatever the precision.
        const double off = length(direction_of(trace<P>(corner, o, d, stats)) + d);
        EXPECT_LE(off, 8 * (P::u + Float::u));
        worst.see(off / Float::u);
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, ABoxOfMirrorsUnfoldsIntoALattice)
{
    using P = TypeParam;
    const Native room(mirrors({complement(cuboid({0, 0, 0}, {2, 2, 2}))}));
    const Vec3 o{.125, -.25, .375}, start = to_real<P>(scene::unit({.31, .52, .79}));
    Path path{o, start, MEMBER_NONE, false};
    Stats stats{};
    long double travelled = 0;
    const long double size =
        std::sqrt(static_cast<long double>(start.x) * start.x + static_cast<long double>(start.y) * start.y +
                  static_cast<long double>(start.z) * start.z);
    Measured worst("place_a_chord");
    for (int k = 0; k < 100; k++) {
        const auto hit = next_hit<P>(room, path, {}, stats);
        ASSERT_TRUE(hit);
        travelled += length(hit->p - path.o);
        path = back(*hit, path.d - hit->n * (2 * dot(hit->n, path.d)));
        const auto fold = [&](double from, double along) {
            const long double y = std::fmod(std::fabs(from + travelled * along / size + 1), 4.0L);
            return static_cast<double>(y < 2 ? y - 1 : 3 - y);
        };
        const Vec3 expected{fold(o.x, start.x), fold(o.y, start.y), fold(o.z, start.z)};
        // Each chord adds some units of a length of about 1.
        ASSERT_LE(length(path.o - expected), 8 * P::u * (k + 1));
        worst.see(length(path.o - expected) / P::u / (k + 1));
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, ARayThatGrazesASphereIsJudgedRightBeyondFourUnits)
{
    using P = TypeParam;
    const Native ball(mirrors({sphere({0, 0, 0}, 1)}));
    Stats stats{};
    for (const double distance : {2., 10., 1e3, 1e6}) {
        for (int k = 5; k <= 64; k++) {
            const auto hits = [&](double h) {
                return next_hit<P>(ball, {{-distance, h, 0}, {1, 0, 0}}, {}, stats).has_value();
            };
            EXPECT_FALSE(hits(1 + 2 * k * P::u)) << k << " at " << distance;
            EXPECT_TRUE(hits(1 - 2 * k * P::u)) << k << " at " << distance;
        }
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, ACylinderIsLeftAtTheRightLengthHoweverFlatTheRay)
{
    using P = TypeParam;
    const Native tube(scene_of({solid(scene::Cylinder{{0, 0, 0}, {0, 0, 1}})}));
    Stats stats{};
    Measured worst("length");
    for (double sine = .1; sine > 5e-8; sine /= 10) {
        const Vec3 d = to_real<P>(Vec3{sine, 0, std::sqrt(1 - sine * sine)});
        const auto hit = next_hit<P>(tube, {{0, 0, 0}, d}, {0U}, stats);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->t * d.x / length(d), 1, 8 * P::u) << sine;
        worst.see((hit->t * d.x / length(d) - 1) / P::u);
    }
    EXPECT_FALSE(next_hit<P>(tube, {{.5, .25, -3}, {0, 0, 1}}, {0U}, stats)); // along the axis, inside
    EXPECT_FALSE(next_hit<P>(tube, {{1.5, .25, -3}, {0, 0, 1}}, {}, stats));  // and outside
    EXPECT_FALSE(next_hit<P>(tube, {{0, 0, 0}, {0, 0, 1}}, {0U}, stats));     // on it
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, ARayParallelToAConesGeneratorMeetsItOnce)
{
    using P = TypeParam;
    const Native cone(scene_of({solid(scene::Cone{{0, 0, 0}, {0, 0, 1}})}));
    Stats stats{};
    const double a = to_real<P>(std::sqrt(.5));
    for (const int ulps : {-1, 0, 1}) {
        const Vec3 d{a + ulps * P::u, 0, a};
        const auto hit = next_hit<P>(cone, {{0, .5, -3}, d}, {0U}, stats); // below the apex, inside
        ASSERT_TRUE(hit) << ulps;
        // x = t a, z = -3 + t a, y = 1/2: 6 t a = 9 - 1/4.
        EXPECT_NEAR(hit->p.x, (9 - .25) / 6, 8 * P::u * 4) << ulps;
        EXPECT_NEAR(hit->p.z, (9 - .25) / 6 - 3, 8 * P::u * 4) << ulps;
    }
    const auto once = next_hit<P>(cone, {{0, .5, -3}, {a, 0, a}}, {0U}, stats);
    EXPECT_FALSE(next_hit<P>(cone, beyond(*once, {a, 0, a}), {}, stats));
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, RaysAtAConesApexGiveNumbers)
{
    using P = TypeParam;
    const Native cone(scene_of({solid(scene::Cone{{0, 0, 0}, {0, 0, 1}})}));
    Random random(5);
    Stats stats{};
    for (const double miss : {0., 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, .1, 1.}) {
        for (int i = 0; i < 500 / P::share; i++) {
            const Vec3 o = to_real<P>(random_direction(random) * 4);
            const Vec3 d = scene::unit(random_direction(random) * miss - o);
            const bool inside = o.x * o.x + o.y * o.y < o.z * o.z;
            std::vector<u32> in(inside ? 1 : 0, 0U);
            Path path{o, d, MEMBER_NONE, false};
            int events = 0;
            while (const auto hit = next_hit<P>(cone, path, in, stats)) {
                ASSERT_TRUE(std::isfinite(hit->t + hit->p.x + hit->p.y + hit->p.z + hit->n.x + hit->n.y + hit->n.z));
                in.assign(in.empty() ? 1 : 0, 0U);
                path = beyond(*hit, d);
                ASSERT_LE(++events, 2);
            }
        }
        EXPECT_EQ(stats[STAT_PARITY], 0U) << "when aimed to miss by " << miss;
        stats[STAT_PARITY] = 0;
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, RulingsLieInTheirSurfaceAndCrossNothing)
{
    using P = TypeParam;
    Stats stats{};
    const double a = to_real<P>(std::sqrt(.5));
    const Native waist(scene_of({solid(scene::Hyperboloid{{0, 0, 0}, {0, 0, 1}, 1})}));
    EXPECT_FALSE(next_hit<P>(waist, {{1, -3, -3}, {0, a, a}}, {}, stats));
    EXPECT_FALSE(next_hit<P>(waist, {{1, -3, 3}, {0, a, -a}}, {}, stats));
    const Native saddle(scene_of({solid(scene::Saddle{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}})}));
    EXPECT_FALSE(next_hit<P>(saddle, {{-2, -2, 0}, {a, a, 0}}, {}, stats));
    EXPECT_FALSE(next_hit<P>(saddle, {{-2, 2, 0}, {a, -a, 0}}, {}, stats));
    expect_sound(stats);
}

TYPED_TEST(KernelsMirrors, SaddlesAndParaboloidsAreMetOnceAlongTheirAxis)
{
    using P = TypeParam;
    Stats stats{};
    const Native saddle(scene_of({solid(scene::Saddle{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}})}));
    const auto down = next_hit<P>(saddle, {{.5, .25, 5}, {0, 0, -1}}, {}, stats);
    ASSERT_TRUE(down);
    EXPECT_NEAR(down->p.z, .1875, 4 * P::u);
    EXPECT_FALSE(next_hit<P>(saddle, beyond(*down, {0, 0, -1}), {0U}, stats));
    const Native bowl(scene_of({solid(scene::Paraboloid{{0, 0, 0}, {0, 0, .5}})}));
    const auto up = next_hit<P>(bowl, {{.5, .25, -5}, {0, 0, 1}}, {}, stats);
    ASSERT_TRUE(up);
    EXPECT_NEAR(up->p.z, .15625, 4 * P::u);
    EXPECT_FALSE(next_hit<P>(bowl, beyond(*up, {0, 0, 1}), {0U}, stats));
    expect_sound(stats);
}

} // namespace
} // namespace clucida::test
