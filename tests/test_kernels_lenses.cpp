// Refraction against closed forms: lenses, prisms, rainbows, plates, the critical angle, Fresnel's weights.
#include "native_scene.h"

#include <numbers>

namespace clucida::test {
namespace {

using scene::dot;
constexpr double degree = std::numbers::pi / 180;

template <typename P>
class KernelsLenses : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsLenses, Machines, MachineNames);

/// A ray on its way through glass of one index, object 0, in vacuum.
template <typename P>
struct Walker {
    const Native& scene;
    double index;
    Path path;
    std::vector<u32> inside{};
    Stats stats{};

    Hit meet()
    {
        const auto hit = next_hit<P>(scene, path, inside, stats);
        EXPECT_TRUE(hit.has_value());
        return hit.value_or(Hit{});
    }
    bool refract()
    {
        const Hit hit = meet();
        const Vec3 n = facing(hit, path.d);
        const double w = inside.empty() ? 1 / index : index;
        const Bend bend = P::bend(path.d, n, w);
        if (!bend.passes) return false;
        path = beyond(hit, bend.refracted);
        inside.assign(inside.empty() ? 1 : 0, 0U);
        return true;
    }
    void reflect()
    {
        const Hit hit = meet();
        path = back(hit, P::bend(path.d, facing(hit, path.d), 1).reflected);
    }
};

Scene glass(SolidPtr solid, double index)
{
    Scene scene = empty_scene();
    scene.sky = scene::SkyRgb{};
    add(scene, std::move(solid), clear(index));
    return scene;
}

TYPED_TEST(KernelsLenses, ABallLensFocusesWhereItMust)
{
    using P = TypeParam;
    const Native ball(glass(sphere({0, 0, 0}, 1), 1.5));
    const std::pair<double, double> heights[]{
        {.01, 1.4999583327}, {.1, 1.4958270631}, {.5, 1.3915729489}, {.9, 1.1044455684}};
    Measured worst("axis_times_height");
    for (const auto& [h, crossing] : heights) {
        const double height = to_real<P>(h);
        Walker<P> ray{ball, 1.5, {{-3, height, 0}, {1, 0, 0}}};
        ASSERT_TRUE(ray.refract() && ray.refract());
        const double x = ray.path.o.x - ray.path.o.y * ray.path.d.x / ray.path.d.y;
        // The angle of the exit is off by some units; crossing the axis divides that by the height.
        EXPECT_NEAR(x, crossing, 16 * P::u / h + 1e-10);
        worst.see((x - crossing) * h / P::u);
        expect_sound(ray.stats);
    }
}

TYPED_TEST(KernelsLenses, APrismAtMinimumDeviationDeviatesByTheBooksAngle)
{
    using P = TypeParam;
    const double s = std::sqrt(3) / 2; // a roof of 60 degrees over z = 0, its edge along y
    const Native prism(glass(solid(scene::Intersection{{plane({0, 0, 1}, {s, 0, .5}), plane({0, 0, 1}, {-s, 0, .5}),
                                                        plane({0, 0, 0}, {0, 0, -1})}}),
                             1.5));
    // Inside along x: it comes up on the left by half of the deviation.
    const double half = .5 * 37.1807557815 * degree;
    const Vec3 d{std::cos(half), 0, std::sin(half)};
    Walker<P> ray{prism, 1.5, {Vec3{-.25, 0, .5} - d * 2, d}};
    ASSERT_TRUE(ray.refract() && ray.refract());
    const double deviation = std::atan2(d.z, d.x) - std::atan2(ray.path.d.z, ray.path.d.x);
    // Four normals and directions, each off by up to two units; at the minimum the incidence itself does not count.
    // The buffers' normals are floats, whatever the precision.
    EXPECT_NEAR(deviation, 37.1807557815 * degree, 16 * P::u + 2 * Float::u);
    Measured("deviation").see((deviation - 37.1807557815 * degree) / P::u);
    const Rgb seen = trace<P>(prism, Vec3{-.25, 0, .5} - d * 2, d, ray.stats);
    EXPECT_NEAR(direction_of(seen).x, ray.path.d.x, 8 * P::u);
    EXPECT_NEAR(direction_of(seen).z, ray.path.d.z, 8 * P::u);
    expect_sound(ray.stats);
}

TYPED_TEST(KernelsLenses, RainbowsStandAtTheirAngles)
{
    using P = TypeParam;
    const double index = to_real<Float>(4.0 / 3);
    const Native drop(glass(sphere({0, 0, 0}, 1), index));
    const std::tuple<int, double, double> bows[]{{1, 59.3911023403, 42.0296588657}, {2, 71.8319712427, 50.9780935257}};
    Measured worst("angle");
    for (const auto& [reflections, incidence, angle] : bows) {
        Walker<P> ray{drop, index, {{-3, to_real<P>(std::sin(incidence * degree)), 0}, {1, 0, 0}}};
        ASSERT_TRUE(ray.refract());
        for (int k = 0; k < reflections; k++) ray.reflect();
        ASSERT_TRUE(ray.refract());
        // From the antisolar point: the sun shines along x, and the drop is seen in the direction back.
        const double seen = std::atan2(std::fabs(ray.path.d.y), -ray.path.d.x);
        // The index is a float, 4e-8 off 4/3, and moves the bows by 2.5 and 4.6 times that.
        const double inner = std::asin(std::sin(incidence * degree) / index);
        const double exact = reflections == 1 ? 4 * inner - 2 * incidence * degree
                                              : std::numbers::pi + 2 * incidence * degree - 6 * inner;
        EXPECT_NEAR(seen, exact, 32 * P::u);
        worst.see((seen - exact) / P::u);
        EXPECT_NEAR(seen, angle * degree, 32 * P::u + 2e-7);
        expect_sound(ray.stats);
    }
}

TYPED_TEST(KernelsLenses, APlaneParallelPlateShiftsARayAndKeepsItsDirection)
{
    using P = TypeParam;
    const Native plate(glass(cuboid({0, 0, 0}, {0, 0, 1}), 1.5));
    const Vec3 d = to_real<P>(Vec3{std::sin(60 * degree), 0, -std::cos(60 * degree)});
    Walker<P> ray{plate, 1.5, {{-1, 0, 1}, d}};
    ASSERT_TRUE(ray.refract() && ray.refract());
    EXPECT_LE(scene::length(ray.path.d - scene::unit(d)), 4 * P::u);
    Measured("direction").see(scene::length(ray.path.d - scene::unit(d)) / P::u);
    const Vec3 off = ray.path.o - Vec3{-1, 0, 1};
    EXPECT_NEAR(scene::length(off - d * dot(off, d)), .5124720132, 16 * P::u + 1e-10);
    expect_sound(ray.stats);
}

TYPED_TEST(KernelsLenses, TheCriticalAngleIsRightBeyondTwoUnitsInSine)
{
    using P = TypeParam;
    const double critical = to_real<P>(1 / 1.5L);
    for (int k = -50; k <= 50; k++) {
        const long double sine = critical + k * static_cast<long double>(P::u);
        if (std::fabs(static_cast<double>(sine - 2 / 3.0L)) <= 2 * P::u) continue;
        const auto cosine = static_cast<double>(std::sqrt(1 - sine * sine));
        const Vec3 d{static_cast<double>(sine), 0, -cosine};
        EXPECT_EQ(P::bend(d, {0, 0, 1}, 1.5).passes, sine < 2 / 3.0L) << k;
    }
}

TYPED_TEST(KernelsLenses, TheWorldAboveWaterLiesInSnellsWindow)
{
    using P = TypeParam;
    Scene scene = glass(plane({0, 0, 1}, {0, 0, 1}), 4.0 / 3);
    scene.sky = scene::SkyColor{{1, 1, 1}};
    add(scene, plane({0, 0, -1}, {0, 0, 1}), Optics{}); // the ground, black
    std::swap(scene.objects[0], scene.objects[1]);
    View view;
    view.width = 2;
    view.height = 2;
    for (const double off : {-1e-5, 1e-5}) {
        const double angle = 48.5903778907 * degree + off;
        auto& eye = std::get<scene::Pinhole>(scene.observer);
        eye.look = {std::sin(angle), 0, std::cos(angle)};
        eye.up = {0, 1, 0};
        eye.fov = 1e-6;
        const Image image = render<P>(scene, view);
        EXPECT_EQ(image.at(0, 0), off < 0 ? (Rgb{1, 1, 1}) : (Rgb{0, 0, 0}));
        expect_sound(image.stats);
    }
}

TYPED_TEST(KernelsLenses, FresnelsEquationsGiveTheBooksValues)
{
    using P = TypeParam;
    const Vec3 n{0, 0, 1};
    const Bend head_on = P::bend({0, 0, -1}, n, 1 / 1.5);
    ASSERT_TRUE(head_on.passes);
    EXPECT_NEAR(head_on.reflectance, .04, 8 * P::u * .04);
    const double brewster = 56.3099324740 * degree;
    const Vec3 d = to_real<P>(Vec3{std::sin(brewster), 0, -std::cos(brewster)});
    const Bend at_brewster = P::bend(d, n, 1 / 1.5);
    ASSERT_TRUE(at_brewster.passes);
    // Half of R_s, which is 0.1479289941, and no p-polarised light.
    EXPECT_NEAR(at_brewster.reflectance, .1479289941 / 2, 16 * P::u + 1e-10);
    Measured("head_on_relative").see((head_on.reflectance / .04 - 1) / P::u);
    // Grazing, everything reflects; at an index of 1 nothing does.
    const Bend grazing = P::bend({1, 0, 0}, n, 1 / 1.5);
    ASSERT_TRUE(grazing.passes);
    EXPECT_EQ(grazing.reflectance, 1);
    const Bend none = P::bend(d, n, 1);
    ASSERT_TRUE(none.passes);
    EXPECT_EQ(none.reflectance, 0);
    EXPECT_EQ(none.refracted, d);
}

TYPED_TEST(KernelsLenses, RefractedDirectionsObeySnellsLaw)
{
    using P = TypeParam;
    Random random(7);
    for (int i = 0; i < 20000 / P::share; i++) {
        const Vec3 d = to_real<P>(random_direction(random));
        Vec3 n = to_real<P>(random_direction(random));
        if (dot(d, n) > 0) n = -n;
        const double w = to_real<P>(log_uniform(random, .4, 2.5));
        const Vec3 across = scene::cross(d, n) * w; // sin of the angle of refraction, and its plane
        const double sine = scene::length(across);
        const Bend bend = P::bend(d, n, w);
        if (std::fabs(sine - 1) < 8 * P::u) continue;
        ASSERT_EQ(bend.passes, sine < 1) << sine;
        if (!bend.passes) continue;
        const Vec3 o = bend.refracted;
        // n and d are unit to half a unit each component, which w passes on, near the critical angle by more.
        const double tolerance = 8 * P::u * (1 + w);
        EXPECT_LE(scene::length(scene::cross(o, n) - across), tolerance);
        EXPECT_NEAR(dot(o, o), 1, 4 * P::u);
        EXPECT_LE(dot(o, n), 0);
        EXPECT_GE(bend.reflectance, 0);
        EXPECT_LE(bend.reflectance, 1);
    }
}

TYPED_TEST(KernelsLenses, AReversedPathOfTenHopsComesBack)
{
    using P = TypeParam;
    const Native ball(glass(sphere({0, 0, 0}, 1), 1.5));
    const Vec3 start{-3, .3125, .1875};
    Walker<P> ray{ball, 1.5, {start, {1, 0, 0}}};
    ASSERT_TRUE(ray.refract());
    for (int k = 0; k < 7; k++) ray.reflect();
    ASSERT_TRUE(ray.refract());
    // Turn round a little off the ball, as from a mirror there.
    Walker<P> back{ball, 1.5, {to_real<P>(ray.path.o + ray.path.d), -ray.path.d}};
    ASSERT_TRUE(back.refract());
    for (int k = 0; k < 7; k++) back.reflect();
    ASSERT_TRUE(back.refract());
    const Vec3 off = back.path.o - start;
    // Each of twenty events adds some units of angle, which travel over chords of up to two radii.
    EXPECT_LE(scene::length(back.path.d - Vec3{-1, 0, 0}), 400 * P::u);
    EXPECT_LE(std::hypot(off.y, off.z), 800 * P::u);
    Measured("direction").see(scene::length(back.path.d - Vec3{-1, 0, 0}) / P::u);
    expect_sound(back.stats);
}

/// The angle between a direction and a normal, of floats in a wider type.
double incidence(Vec3 n, Vec3 d)
{
    const auto across = [](double a, double b, double c, double e) {
        return static_cast<long double>(a) * b - static_cast<long double>(c) * e;
    };
    const long double x = across(n.y, d.z, n.z, d.y), y = across(n.z, d.x, n.x, d.z), z = across(n.x, d.y, n.y, d.x);
    const long double cosine =
        static_cast<long double>(n.x) * d.x + static_cast<long double>(n.y) * d.y + static_cast<long double>(n.z) * d.z;
    return static_cast<double>(std::atan2(std::sqrt(x * x + y * y + z * z), std::fabs(cosine)));
}

/// The worst drift of the angle and out of the plane, in a thousand total reflections in the plane of x and y.
template <typename P>
void check_gallery(const Native& ball, double angle, Vec3 x, Vec3 y, Measured& worst)
{
    const double a = angle * degree;
    Walker<P> ray{ball, 1.5, {to_real<P>(y * std::sin(a)), to_real<P>(x)}, {0U}};
    const Vec3 start = ray.path.o, plane = scene::unit(scene::cross(ray.path.o, ray.path.d));
    double first = 0, drift = 0, out_of_plane = 0;
    for (int k = 0; k < 1000; k++) {
        const Hit hit = ray.meet();
        ASSERT_EQ(hit.after, vacuum) << "after " << k;
        const double now = incidence(hit.n, ray.path.d);
        // Where a ray meets the ball is good to a unit times 1/cos; from there on the angle stays.
        if (k == 0) {
            first = now;
            EXPECT_NEAR(first, std::asin(scene::length(scene::cross(start, ray.path.d))), 8 * P::u / std::cos(a));
        }
        ASSERT_GT(now, std::asin(1 / 1.5)) << "it escapes after " << k;
        drift = std::max(drift, std::fabs(now - first));
        out_of_plane = std::max(out_of_plane, std::fabs(dot(hit.p, plane)));
        ray.path = back(hit, P::bend(ray.path.d, facing(hit, ray.path.d), 1).reflected);
    }
    EXPECT_LE(drift, 1e-5 * P::u / Float::u + 1e-14) << "at " << angle << " degrees";
    worst.see(drift / P::u);
    EXPECT_LE(out_of_plane, 1e-4 * P::u / Float::u) << "at " << angle << " degrees";
    expect_sound(ray.stats);
}

TYPED_TEST(KernelsLenses, AThousandTotalReflectionsStayInTheirPlaneAndAngle)
{
    using P = TypeParam;
    const Native ball(glass(sphere({0, 0, 0}, 1), 1.5));
    Random random(16);
    for (const double angle : {60.0, 89.9}) {
        Measured worst(angle < 89 ? "drift_at_60_degrees" : "drift_at_89_9_degrees");
        check_gallery<P>(ball, angle, {1, 0, 0}, {0, 0, 1}, worst);
        for (int i = 0; i < 16 / P::share; i++) { // in other planes, for their roundings
            const Vec3 x = random_direction(random), y = scene::unit(scene::cross(x, random_direction(random)));
            check_gallery<P>(ball, angle, x, y, worst);
        }
    }
}

TYPED_TEST(KernelsLenses, LightCaughtInABallIsTracedToTheLastHop)
{
    using P = TypeParam;
    Scene scene = glass(sphere({0, 0, 0}, 1), 1.5);
    scene.sky = scene::SkyColor{{1, 1, 1}};
    scene.settings.max_hops = 1001;
    scene.observer = scene::Pinhole{{0, 0, .875}, {1, 0, .875}, {0, 0, 1}, 1e-6};
    View view;
    view.width = view.height = 1;
    const Image image = render<P>(scene, view);
    EXPECT_EQ(image.at(0, 0), (Rgb{0, 0, 0}));
    EXPECT_EQ(image.stats[STAT_RAYS], 1001U);
    EXPECT_EQ(image.stats[STAT_REFLECTED], 1000U);
    EXPECT_EQ(image.stats[STAT_HOP_BRANCHES], 1U);
    EXPECT_EQ(image.stats[STAT_TRUNCATED], 65536U);
    expect_sound(image.stats);
}

} // namespace
} // namespace clucida::test
