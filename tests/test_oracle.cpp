// The oracle against closed forms (docs/hard-cases.md), in each of its real types.
#include "oracle_world.h"

#include <fmt/format.h>
#include <numbers>

namespace clucida::oracle {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

template <typename T>
class OracleForms : public ::testing::Test {
};
TYPED_TEST_SUITE(OracleForms, Types, TypeNames);

/// Where the sky is seen, by the direction that arrives there.
template <typename Real>
Vec<double> leaves_along(const World<Real>& world, const Three<Real>& o, const Three<Real>& d)
{
    return direction_of(follow(world, o, d).rgb);
}

const std::string see_through = "reflection 0; refraction 1;";

TYPED_TEST(OracleForms, ABallLensBringsParallelRaysToTheAxisWhereSnellSays)
{
    using Real = typename TypeParam::Real;
    const auto world =
        world_of<TypeParam>("sky rgb\nobject { solid sphere([0,0,0], 1); optics { index 1.5; " + see_through + " } }");
    const std::array<std::array<double, 2>, 4> table{
        {{.01, 1.4999583327}, {.1, 1.4958270631}, {.5, 1.3915729489}, {.9, 1.1044455684}}};
    for (const auto& [height, crosses] : table) {
        const Vec<double> d = leaves_along<Real>(world, {Real(height), Real(0), Real(-5)}, {Real(0), Real(0), Real(1)});
        const double turned = 2 * (std::asin(height) - std::asin(height / 1.5));
        EXPECT_NEAR(std::atan2(-d.x, d.z), turned, roundings<TypeParam>(32));
        // The way out is as far from the centre as the way in.
        EXPECT_NEAR(height / -d.x, crosses, height < .1 ? 1e-10 : 6e-11) << "at height " << height;
        EXPECT_LE(std::fabs(d.y), roundings<TypeParam>(4));
    }
}

TYPED_TEST(OracleForms, APrismTurnsARayAtMinimumDeviationByThatAngle)
{
    using Real = typename TypeParam::Real;
    // Its edge along y; the ray inside runs along x.
    const auto world = world_of<TypeParam>(fmt::format(
        "sky rgb\nlet s = sqrt(3)/2\nobject {{ solid plane([0,0,1], [-s,0,0.5]) & plane([0,0,1], [s,0,0.5]) & "
        "plane([0,0,-9], [0,0,-1]); optics {{ index 1.5; {} }} }}",
        see_through));
    const Real incidence = asin(Real(Real(3) / Real(4))), up = incidence - pi<Real>() / Real(6);
    EXPECT_NEAR(to_double(incidence) * degrees, 48.5903778907, 5e-11);
    const Real c = cos(up), s = sin(up);
    const Vec<double> d = leaves_along<Real>(world, {Real(-9) * c, Real(0), Real(-9) * s}, {c, Real(0), s});
    EXPECT_NEAR(d.z, -to_double(s), 1e-15);
    EXPECT_NEAR((std::atan2(-d.z, d.x) + to_double(up)) * degrees, 37.1807557815, 5e-11);
}

/// What arrives with just so many segments and no fewer.
template <typename T>
Vec<double> last_leaves_along(const std::string& text, unsigned hops, const Three<typename T::Real>& o,
                              const Three<typename T::Real>& d)
{
    const Three<double> with = follow(world_of<T>(text, free_options(hops)), o, d).rgb;
    const Three<double> without = follow(world_of<T>(text, free_options(hops - 1)), o, d).rgb;
    return direction_of({with[0] - without[0], with[1] - without[1], with[2] - without[2]});
}

TYPED_TEST(OracleForms, ARainbowStandsWhereDescartesFoundIt)
{
    using Real = typename TypeParam::Real;
    const std::string drop =
        "sky rgb\nobject { solid sphere([0,0,0], 1); optics { index 4/3; reflection 1; refraction 1 } }";
    const std::array<std::array<double, 2>, 2> table{{{59.3911023403, 42.0296588657}, {71.8319712427, 50.9780935257}}};
    for (unsigned k = 1; k <= 2; k++) {
        // Minimum deviation after k inner reflections: cos^2 i = (n^2 - 1) / (k (k + 2)).
        const Real cos2 = Real(7) / Real(9) / Real(k * (k + 2)), height = sqrt(Real(Real(1) - cos2));
        EXPECT_NEAR(to_double(asin(height)) * degrees, table[k - 1][0], 6e-11);
        const Vec<double> d =
            last_leaves_along<TypeParam>(drop, k + 3, {height, Real(0), Real(-5)}, {Real(0), Real(0), Real(1)});
        EXPECT_NEAR(std::atan2(std::fabs(d.x), -d.z) * degrees, table[k - 1][1], 1e-10);
    }
}

TYPED_TEST(OracleForms, APlateShiftsARayAndRestoresItsDirection)
{
    using Real = typename TypeParam::Real;
    const std::string plate = "object { solid cuboid([0,0,0], [0,0,1]); optics { index 1.5; " + see_through + " } }";
    const Three<Real> d{sin(Real(pi<Real>() / Real(3))), Real(0), Real(.5)}, o{-d[0] * Real(4), Real(0), Real(-2)};
    const Vec<double> out = leaves_along(world_of<TypeParam>("sky rgb\n" + plate), o, d);
    EXPECT_NEAR(out.x, std::sqrt(.75), 2 * 0x1p-52);
    EXPECT_NEAR(out.z, .5, 2 * 0x1p-52);
    // Beyond it a wedge of index 1, right-angled, its edge on the line of the ray that came: a ray along the line at a
    // distance s runs 2 s in it.
    const std::string wedge = "let s = sqrt(3)/2\n"
                              "object { solid plane([9*s, 0, 4.5], [s + 0.5, 0, 0.5 - s]) & "
                              "plane([9*s, 0, 4.5], [0.5 - s, 0, -0.5 - s]); "
                              "optics { index 1; passthrough 0.5; reflection 0; refraction 1 } }";
    const auto there = world_of<TypeParam>("sky color 1\n" + plate + "\n" + wedge);
    const double sine = std::sqrt(.75), shift = sine * (1 - .5 / std::sqrt(1.5 * 1.5 - .75));
    EXPECT_NEAR(shift, .5124720132, 6e-11);
    EXPECT_NEAR(-std::log2(follow(there, o, d).rgb[0]) / 2, shift, 4e-15);
}

TYPED_TEST(OracleForms, TheCriticalAngleIsWhereSnellPutsIt)
{
    using Real = typename TypeParam::Real;
    const std::array<std::array<int, 2>, 2> indices{{{3, 2}, {4, 3}}};
    for (const auto& [over, under] : indices) {
        const auto world = world_of<TypeParam>(
            fmt::format("object {{ solid plane([0,0,0], [0,0,1]); optics {{ index {}/{}; reflection 1; refraction 1 }} "
                        "}}",
                        over, under));
        // 4/3 in double is not four thirds.
        const Real critical = Real(1) / world.optics[0].index;
        for (const double sign : {-1.0, 1.0}) {
            const Real sine = critical * (Real(1) + Real(sign * 16 * epsilon<Real>()));
            const Three<Real> d{sine, Real(0), sqrt(Real(Real(1) - sine * sine))};
            const Path path = follow<Real>(world, {Real(0), Real(0), Real(-1)}, d);
            ASSERT_FALSE(path.events.empty());
            EXPECT_EQ((path.events[0].what & what_total) != 0, sign > 0) << over << "/" << under << ", side " << sign;
        }
    }
    EXPECT_NEAR(std::asin(2.0 / 3) * degrees, 41.8103148958, 5e-11);
    EXPECT_NEAR(std::asin(3.0 / 4) * degrees, 48.5903778907, 5e-11);
}

TYPED_TEST(OracleForms, AHollowSphericalMirrorSendsARayThroughTheAxisAtHalfTheSecant)
{
    using Real = typename TypeParam::Real;
    const auto world = world_of<TypeParam>(
        "sky rgb\nobject { solid plane([0,0,0.5], [0,0,-1]) - sphere([0,0,0], 1); optics { reflection 1 } }");
    const Real height = sin(Real(.5)), depth = cos(Real(.5));
    const Vec<double> d = leaves_along<Real>(world, {height, Real(0), Real(0)}, {Real(0), Real(0), Real(1)});
    EXPECT_NEAR(to_double(depth) - to_double(height) * d.z / d.x, .569746963662274561, 1e-15);
}

TYPED_TEST(OracleForms, AParabolicMirrorSendsRaysAlongItsAxisThroughTheFocus)
{
    using Real = typename TypeParam::Real;
    const auto world = world_of<TypeParam>("sky rgb\nobject { solid plane([0,0,0.25], [0,0,1]) - "
                                           "paraboloid([0,0,0], [0,0,0.5]); optics { reflection 1 } }");
    for (const double x : {.01, .1, .5, .7}) {
        const Vec<double> d = leaves_along<Real>(world, {Real(x), Real(0), Real(5)}, {Real(0), Real(0), Real(-1)});
        const Vec<double> to_focus{-x, 0, .5 - x * x / 2};
        EXPECT_LE(length(cross(d, unit(to_focus))), 1e-15) << "at " << x;
        EXPECT_LT(d.x, 0);
    }
}

TYPED_TEST(OracleForms, FresnelsWeightsAreThoseOfTheTextbook)
{
    using Real = typename TypeParam::Real;
    const auto reflectance = [](const Real& sine) {
        const auto world = world_of<TypeParam>("sky color 1\nobject { solid plane([0,0,0], [0,0,1]); optics { "
                                               "index 1.5; reflection 1; refraction 0; fresnel } }");
        const Real cosine = sqrt(Real(Real(1) - sine * sine));
        return follow<Real>(world, {-sine, Real(0), cosine}, {sine, Real(0), -cosine}).rgb[0];
    };
    EXPECT_NEAR(reflectance(Real(0)), .04, 1e-17);
    const Real brewster = Real(1.5) / sqrt(Real(3.25));
    EXPECT_NEAR(to_double(asin(brewster)) * degrees, 56.3099324740, 5e-11);
    const double perpendicular = std::pow(1.25 / 3.25, 2);
    EXPECT_NEAR(perpendicular, .1479289941, 5e-11);
    EXPECT_NEAR(2 * reflectance(brewster), perpendicular, 1e-16) << "nothing of the parallel light";
    const double beyond = std::sqrt(1 - std::pow(.8 / 1.5, 2));
    const double across = (.6 - 1.5 * beyond) / (.6 + 1.5 * beyond), along = (beyond - .9) / (beyond + .9);
    EXPECT_NEAR(reflectance(Real(Real(4) / Real(5))), (across * across + along * along) / 2, 1e-16);
}

TYPED_TEST(OracleForms, AThousandThinSlabsLetThroughWhatOneSlabDoes)
{
    using Real = typename TypeParam::Real;
    const std::string optics = "optics { index 1; refraction 1; passthrough [0.5, 0.25, 0.9] }";
    const auto through = [&](int slabs, unsigned hops) {
        scene::Scene scene = read("sky color 1\nobject { solid cuboid([0,0,0.5], [0,0,1]); " + optics + " }");
        scene.objects.resize(1, scene.objects[0]);
        const scene::Object slab = scene.objects[0];
        scene.objects.clear();
        for (int i = 0; i < slabs; i++) {
            scene::Object& object = scene.objects.emplace_back(slab);
            // Faces by the same arithmetic for both neighbours.
            const double low = static_cast<double>(i) / slabs, high = static_cast<double>(i + 1) / slabs;
            const auto face = [](double z, double side) {
                return scene::make_solid(scene::Plane{{0, 0, z}, {0, 0, side}});
            };
            object.solid = scene::make_solid(scene::Intersection{{face(low, -1), face(high, 1)}});
        }
        const auto world = build<Real>(scene, free_options(hops));
        return follow<Real>(world, {Real(0), Real(0), Real(-1)}, {Real(0), Real(.6), Real(.8)});
    };
    const Path one = through(1, 3), thousand = through(1000, 1002);
    EXPECT_EQ(thousand.events.size(), 1002U);
    const Three<double> expected{std::pow(.5, 1.25), std::pow(.25, 1.25), std::pow(.9, 1.25)};
    EXPECT_LE(farthest(one.rgb, expected), 4e-16);
    EXPECT_LE(farthest(thousand.rgb, expected), roundings<TypeParam>(1000));
    EXPECT_EQ(through(1000, 1001).rgb, Three<double>{}) << "one hop too few";
}

TYPED_TEST(OracleForms, AWhiteFurnaceIsWhite)
{
    using Real = typename TypeParam::Real;
    // reflection + refraction = 1: what is lost is told.
    const auto world = world_of<TypeParam>(
        "sky color 1\nobject { solid sphere([0,0,0], 1) - sphere([0.3,0.1,0], 0.4); optics { index 1.5; "
        "reflection 1; refraction 1; fresnel } }\nobject { solid torus([0,0,0], [1,2,3], 2, 0.6); optics { index 1.3; "
        "reflection 0.25; refraction 0.75 } }",
        free_options(10));
    Random random(7);
    for (int i = 0; i < 20; i++) {
        const Three<Real> d{Real(uniform(random, -.5, .5)), Real(1), Real(uniform(random, -.5, .5))};
        const Path path = follow<Real>(world, {Real(0), Real(-5), Real(0)}, d);
        EXPECT_NEAR(path.rgb[0] + path.truncated, 1, roundings<TypeParam>(64));
    }
}

TYPED_TEST(OracleForms, LightsGiveByTheirLawsAndTheMaskTellsWhich)
{
    using Real = typename TypeParam::Real;
    // 34 lights, all but three of them below the floor; number 33 shares its bit with number 1.
    std::string lights;
    for (int i = 0; i < 34; i++)
        lights += i == 0    ? "light { point [0,0,2]; color 1 }\n"    // overhead
                  : i == 33 ? "light { point [6,0,8]; color 0.5 }\n"  // at a cosine of 0.8
                  : i == 7  ? "light { point [-3,0,4]; color 1 }\n"   // hidden by a ball
                  : i == 8  ? "light { point [0,-3,4]; color 1 }\n"   // inside a ball
                  : i == 9  ? "light { point [0,3,4]; color 0.25 }\n" // on a ball's far side
                            : "light { point [0,0,-1]; color 1 }\n";
    const std::string things = "object { solid plane([0,0,0], [0,0,1]); optics { absorption [1, 0.5, 0] } }\n"
                               "object { solid sphere([-1.5,0,2], 0.1); optics { index 1; refraction 1 } }\n"
                               "object { solid sphere([0,-3,4], 0.5); optics { index 1; refraction 1 } }\n"
                               "object { solid sphere([0,3.6,4.8], 1); optics { absorption 1 } }\n";
    const auto light = [&](const std::string& law) {
        const auto world = world_of<TypeParam>("settings { light_law " + law + " }\n" + lights + things);
        return follow<Real>(world, {Real(.5), Real(0), Real(1)}, {Real(-.5), Real(0), Real(-1)});
    };
    const auto paper = [](double a) { return 2 / std::numbers::pi * std::acos(1 - a); };
    for (const auto& [law, sum] :
         std::vector<std::pair<std::string, double>>{{"paper", paper(1) + .5 * paper(.8) + .25 * paper(.8)},
                                                     {"lambert", 1 + .5 * .8 + .25 * .8},
                                                     {"inverse_square", 1.0 / 4 + .5 * .8 / 100 + .25 * .8 / 25}}) {
        const Path path = light(law);
        ASSERT_EQ(path.events.size(), 1U);
        EXPECT_EQ(path.events[0].lights, 1U | 1U << 1 | 1U << 9) << law;
        EXPECT_LE(farthest(path.rgb, Three<double>{sum, sum / 2, 0}), 4e-15) << law;
    }
}

} // namespace
} // namespace clucida::oracle
