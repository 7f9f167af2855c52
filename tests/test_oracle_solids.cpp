// The oracle's solids: the torus' crossings, quadrics by their coefficients, booleans and precedence.
#include "oracle_world.h"

#include <fmt/format.h>

namespace clucida::oracle {
namespace {

template <typename T>
class OracleSolids : public ::testing::Test {
};
TYPED_TEST_SUITE(OracleSolids, Types, TypeNames);

const std::string clear = "; optics { index 1; refraction 1 } }\n";

template <typename Real>
Three<Real> three(double x, double y, double z)
{
    return {Real(x), Real(y), Real(z)};
}

/// Where the line meets surfaces, in double.
template <typename Real>
std::vector<double> places(const World<Real>& world, const Three<Real>& o, const Three<Real>& d)
{
    std::vector<double> t;
    for (const Hit<Real>& hit : surfaces_along(world, o, d)) t.push_back(to_double(hit.t));
    return t;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance)
{
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); i++)
        EXPECT_NEAR(found[i], expected[i], tolerance * (1 + expected[i])) << "crossing " << i;
}

TYPED_TEST(OracleSolids, ALineAcrossATorusCrossesItFourTimes)
{
    using Real = typename TypeParam::Real;
    const double tolerance = roundings<TypeParam>(64);
    const auto torus = world_of<TypeParam>("object { solid torus([0,0,0], [0,0,1], 2, 0.5)" + clear);
    expect_near(places(torus, three<Real>(-5, 0, 0), three<Real>(1, 0, 0)), {2.5, 3.5, 6.5, 7.5}, tolerance);
    // In the plane of its circle, off the axis: both circles, (1.5, 2.5), at the sagitta's distance.
    expect_near(places(torus, three<Real>(-5, .9, 0), three<Real>(1, 0, 0)),
                {5 - std::sqrt(6.25 - .81), 3.8, 6.2, 5 + std::sqrt(6.25 - .81)}, tolerance);
    // Along the axis through the hole, and down into the ring.
    expect_near(places(torus, three<Real>(0, 0, 5), three<Real>(0, 0, -1)), {}, tolerance);
    expect_near(places(torus, three<Real>(1.2, 1.6, 5), three<Real>(0, 0, -1)), {4.5, 5.5}, tolerance);
    expect_near(places(torus, three<Real>(-1.38, -1.84, 5), three<Real>(0, 0, -1)), {4.6, 5.4}, tolerance);
    // Touching the inner equator from within the ring, the outer from without.
    expect_near(places(torus, three<Real>(1.5, -5, 0), three<Real>(0, 1, 0)), {3, 7}, tolerance);
    expect_near(places(torus, three<Real>(2.5, -5, 0), three<Real>(0, 1, 0)), {}, tolerance);
}

TYPED_TEST(OracleSolids, AMovedTurnedMirroredAndScaledTorusIsCrossedWhereTheLikeLineIs)
{
    using Real = typename TypeParam::Real;
    const auto own = world_of<TypeParam>("object { solid torus([0,0,0], [0,0,1], 2, 0.5)" + clear);
    // p -> 3 turn(mirror(p)) + (1, 2, 3), the turn a third about (1, 1, 1): (x, y, z) -> (z, x, y).
    const auto placed = world_of<TypeParam>("object { solid move([1,2,3], scale(3, rotate([1,1,1], 120, "
                                            "scale([1,1,-1], torus([0,0,0], [0,0,1], 2, 0.5)))))" +
                                            clear);
    const auto place = [](const Three<Real>& p, double offset) {
        return Three<Real>{p[2] * Real(-3) + Real(offset), p[0] * Real(3) + Real(2 * offset),
                           p[1] * Real(3) + Real(3 * offset)};
    };
    Random random(3);
    std::size_t crossed = 0;
    for (int i = 0; i < 100; i++) {
        const Three<Real> o = three<Real>(uniform(random, -4, 4), -6, uniform(random, -4, 4));
        Three<Real> d;
        for (std::size_t k = 0; k < 3; k++) d[k] = Real(uniform(random, -2.2, 2.2)) * Real(k == 2 ? .2 : 1) - o[k];
        std::vector<double> expected = places(own, o, d);
        for (double& t : expected) t *= 3;
        expect_near(places(placed, place(o, 1), place(d, 0)), expected, roundings<TypeParam>(1e6));
        for (const Hit<Real>& hit : surfaces_along(own, o, d)) {
            const Real ring = sqrt(Real(hit.point.x * hit.point.x + hit.point.y * hit.point.y)) - Real(2);
            const Real off = sqrt(Real(ring * ring + hit.point.z * hit.point.z)) - Real(.5);
            EXPECT_LE(std::fabs(to_double(off)), 1e5 * TypeParam::u);
        }
        crossed += expected.size();
    }
    EXPECT_GT(crossed, 150U);
}

/// Primitives and the same solids by ten factors.
const std::vector<std::array<std::string, 2>> alike{
    {"sphere([1,2,3], 2)", "quadric([1,1,1], [0,0,0], [-2,-4,-6], 10)"},
    {"cylinder([0,1,0], [0,0,0.5])", "quadric([4,4,0], [0,0,0], [0,-8,0], 3)"},
    {"cone([0,0,1], [0,0,2])", "quadric([4,4,-1], [0,0,0], [0,0,2], -1)"},
    {"paraboloid([0,0,-1], [0,0,0.5])", "quadric([1,1,0], [0,0,0], [0,0,-2], -2)"},
    {"hyperboloid([0,0,0], [0,0,2], 0.5)", "quadric([16,16,-1], [0,0,0], [0,0,0], -4)"},
    {"saddle([0,0,0], [0,0,0.5], [1,1,0])", "quadric([0,0,0], [-1,0,0], [0,0,1], 0)"},
    {"plane([0,0,1], [1,2,2])", "quadric([0,0,0], [0,0,0], [1,2,2], -2)"},
    {"rotate([1,1,1], 120, scale([1,2,0.5], sphere([0,0,0], 1)))", "quadric([4,1,0.25], [0,0,0], [0,0,0], -1)"},
    {"move([1,-1,2], scale([2,1,1], quadric([1,1,1], [0,0,0], [0,0,0], -1)))",
     "move([1,-1,2], scale([2,1,1], sphere([0,0,0], 1)))"},
};

TYPED_TEST(OracleSolids, AQuadricByItsFactorsIsThePrimitiveThatTheyDescribe)
{
    using Real = typename TypeParam::Real;
    Random random(10);
    for (const auto& [primitive, factors] : alike) {
        SCOPED_TRACE(factors);
        const auto a = world_of<TypeParam>("object { solid " + primitive + clear);
        const auto b = world_of<TypeParam>("object { solid " + factors + clear);
        std::size_t crossed = 0;
        for (int i = 0; i < 60; i++) {
            const Three<Real> o = three<Real>(uniform(random, -5, 5), -6, uniform(random, -5, 5));
            Three<Real> d;
            for (std::size_t k = 0; k < 3; k++) d[k] = Real(uniform(random, -2, 2) + static_cast<double>(k)) - o[k];
            const std::vector<double> expected = places(a, o, d);
            crossed += expected.size();
            const std::vector<double> found = places(b, o, d);
            ASSERT_EQ(found.size(), expected.size());
            for (std::size_t k = 0; k < found.size(); k++)
                EXPECT_NEAR(found[k], expected[k], roundings<TypeParam>(1e5) * (1 + expected[k] * expected[k]));
        }
        EXPECT_GT(crossed, 15U);
    }
}

/// A random tree over balls on the x axis, and whether a point of the axis lies in it.
struct Axis {
    scene::SolidPtr solid;
    std::function<bool(double)> holds;
};

Axis random_tree(Random& random, int depth, std::vector<double>& ends)
{
    if (depth == 0) {
        const double center = uniform(random, -4, 4), radius = uniform(random, .2, 3);
        ends.insert(ends.end(), {center - radius, center + radius});
        return {scene::make_solid(scene::Sphere{{center, 0, 0}, radius}),
                [=](double x) { return std::fabs(x - center) < radius; }};
    }
    const Axis a = random_tree(random, depth - 1, ends), b = random_tree(random, depth - 1, ends);
    switch (random() % 4) {
    case 0:
        return {scene::make_solid(scene::Intersection{{a.solid, b.solid}}),
                [=](double x) { return a.holds(x) && b.holds(x); }};
    case 1:
        return {scene::make_solid(scene::Union{{a.solid, b.solid}}),
                [=](double x) { return a.holds(x) || b.holds(x); }};
    case 2:
        return {scene::make_solid(scene::Difference{a.solid, b.solid}),
                [=](double x) { return a.holds(x) && !b.holds(x); }};
    default: return {scene::make_solid(scene::Complement{a.solid}), [=](double x) { return !a.holds(x); }};
    }
}

TYPED_TEST(OracleSolids, AmongNestedBooleansTheFirstObjectThatHoldsThePointIsTheMedium)
{
    using Real = typename TypeParam::Real;
    Random random(20);
    std::size_t changes = 0;
    for (int i = 0; i < 100; i++) {
        scene::Scene scene = read("object { solid sphere([0,0,0], 1)" + clear);
        const scene::Object object = scene.objects[0];
        scene.objects.clear();
        std::vector<Axis> solids;
        std::vector<double> ends{-20, 20};
        for (int k = 0; k < 3; k++) {
            solids.push_back(random_tree(random, 3, ends));
            scene.objects.push_back(object);
            scene.objects.back().solid = solids.back().solid;
        }
        std::sort(ends.begin(), ends.end());
        const auto medium = [&](double x) {
            for (std::uint32_t k = 0; k < 3; k++)
                if (solids[k].holds(x)) return k;
            return vacuum;
        };
        const auto found =
            surfaces_along<Real>(build<Real>(scene, free_options()), three<Real>(-20, 0, 0), three<Real>(1, 0, 0));
        std::size_t at = 0;
        for (std::size_t k = 1; k + 1 < ends.size(); k++) {
            const std::uint32_t before = medium((ends[k - 1] + ends[k]) / 2);
            const std::uint32_t after = medium((ends[k] + ends[k + 1]) / 2);
            if (before == after) continue;
            ASSERT_LT(at, found.size());
            EXPECT_EQ(found[at].before, before);
            EXPECT_EQ(found[at].after, after);
            EXPECT_EQ(found[at].object, std::min(before, after));
            EXPECT_NEAR(to_double(found[at].t), 20 + ends[k], 20 * roundings<TypeParam>(1e3));
            at++;
        }
        EXPECT_EQ(at, found.size());
        changes += at;
    }
    EXPECT_GT(changes, 300U);
}

TYPED_TEST(OracleSolids, FlushFacesAreCrossedAsOneAndShowTheHigherObject)
{
    using Real = typename TypeParam::Real;
    // 0.1 + 0.2 is not 0.3: the faces are flush by what the text means.
    const auto world =
        world_of<TypeParam>("object { solid cuboid([0.15,0,0], [0.3,1,1])" + clear +
                            "object { solid move([0.1,0,0], cuboid([0.35,0,0], [0.3,1,1]))" + clear +
                            "object { solid cuboid([0,0,0], [4,4,4]) - cuboid([0.3,0,0], [0.6,1,1])" + clear);
    const auto found = surfaces_along(world, three<Real>(-9, .1, .2), three<Real>(1, 0, 0));
    const std::vector<std::array<std::uint32_t, 3>> media{
        {2, vacuum, 2}, {0, 2, 0}, {0, 0, 1}, {1, 1, 2}, {2, 2, vacuum}};
    ASSERT_EQ(found.size(), media.size());
    for (std::size_t i = 0; i < media.size(); i++) {
        const std::array<std::uint32_t, 3> is{found[i].object, found[i].before, found[i].after};
        EXPECT_EQ(is, media[i]) << "surface " << i;
    }
    expect_near(places(world, three<Real>(-9, .1, .2), three<Real>(1, 0, 0)), {7, 9, 9.3, 9.6, 11}, 1e-14);
}

} // namespace
} // namespace clucida::oracle
