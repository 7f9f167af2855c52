// Light and colours: the laws of diffuse light, shadows, filters, emission, media and which of them is in force.
#include "native_scene.h"

#include "scene/pack.h"

#include <numbers>

namespace clucida::test {
namespace {

template <typename P>
class KernelsLight : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsLight, Machines, MachineNames);

Optics optics_of(double reflection, double absorption, double index = 0, double refraction = 0)
{
    Optics o;
    o.reflection = {reflection, reflection, reflection};
    o.absorption = {absorption, absorption, absorption};
    o.index = index;
    o.refraction = {refraction, refraction, refraction};
    return o;
}

template <typename P>
Rgb look(const Scene& scene, Vec3 o = {0, 0, 0}, Vec3 d = {0, 1, 0})
{
    Stats stats{};
    const Rgb color = trace<P>(Native(scene), o, d, stats);
    expect_sound(stats);
    return color;
}

/// What the eye sees along y, the eye's interior known.
template <typename P>
Rgb see(Scene scene, Vec3 eye = {0, 0, 0}, Vec3 d = {0, 1, 0})
{
    scene.observer = scene::Pinhole{eye, eye + d, std::fabs(d.z) > .9 ? Vec3{1, 0, 0} : Vec3{0, 0, 1}, 1e-6};
    View view;
    view.width = view.height = 1;
    const Image image = render<P>(scene, view);
    expect_sound(image.stats);
    return image.at(0, 0);
}

TYPED_TEST(KernelsLight, ThePapersLawHoldsDownToTheTerminator)
{
    using P = TypeParam;
    for (double a = 1; a > 5e-9; a *= .1) {
        const double cosine = to_real<P>(a);
        // acos(1 - a) is 2 asin(sqrt(a/2)), whose series in a long double has no cancellation.
        const long double expected =
            4 / std::numbers::pi_v<long double> * std::asin(std::sqrt(static_cast<long double>(cosine) / 2));
        EXPECT_NEAR(P::diffuse(LAW_PAPER, cosine, 1) / static_cast<double>(expected), 1, 6 * P::u) << a;
    }
    EXPECT_NEAR(P::diffuse(LAW_PAPER, 1, 5), 1, 2 * P::u);
    EXPECT_NEAR(P::diffuse(LAW_PAPER, .5, 5), 2. / 3, 4 * P::u);
    EXPECT_EQ(P::diffuse(LAW_LAMBERT, .375, 5), .375);
    EXPECT_EQ(P::diffuse(LAW_INVERSE_SQUARE, .375, 4), .375 / 16);
}

TYPED_TEST(KernelsLight, FiltersKeepNoughtAndOneAndAreWithinHalfAStepOfTheRoot)
{
    using P = TypeParam;
    for (int i = 0; i <= 1000; i += P::share) {
        const double v = i / 1000.;
        const Rgb color = P::unpack_filter(scene::pack_filter({v, v, v}));
        const double out[3]{color.r, color.g, color.b};
        for (int c = 0; c < 3; c++) {
            const double top = c < 2 ? 2047 : 1023;
            // Half a step of the root is a step of the value times the root, and a little for the step itself.
            EXPECT_NEAR(out[c], v, std::sqrt(v) / top + .25 / (top * top) + 2 * P::u) << v;
        }
    }
    EXPECT_EQ(P::unpack_filter(scene::pack_filter({1, 0, 1})), (Rgb{1, 0, 1}));
}

/// A white wall at y = 4, facing the eye, and a light.
Scene wall(Vec3 light, scene::LightLaw law = scene::LightLaw::lambert)
{
    Scene scene = empty_scene();
    scene.settings.light_law = law;
    add(scene, plane({0, 4, 0}, {0, -1, 0}), optics_of(0, 1));
    scene.lights.push_back({light, {1, 2, 3}, {}});
    return scene;
}

TYPED_TEST(KernelsLight, EachLawLightsAWall)
{
    using P = TypeParam;
    const Rgb lambert = look<P>(wall({3, 0, 0}));
    EXPECT_NEAR(lambert.r, .8, 8 * P::u); // 3, 4, 5
    EXPECT_NEAR(lambert.g, 1.6, 16 * P::u);
    EXPECT_NEAR(lambert.b, 2.4, 24 * P::u);
    EXPECT_NEAR(look<P>(wall({3, 0, 0}, scene::LightLaw::inverse_square)).r, .8 / 25, P::u);
    EXPECT_NEAR(look<P>(wall({3, 0, 0}, scene::LightLaw::paper)).r, 2 / std::numbers::pi * std::acos(.2), 8 * P::u);
    EXPECT_EQ(look<P>(wall({0, 5, 0})).r, 0); // behind the wall
    Scene two = wall({3, 0, 0});
    two.lights.push_back({{-3, 0, 0}, {1, 0, 0}, {}});
    EXPECT_NEAR(look<P>(two).r, 1.6, 16 * P::u);
}

TYPED_TEST(KernelsLight, OnlyWhatLiesBetweenHidesALight)
{
    using P = TypeParam;
    const auto lit = [](SolidPtr solid, Vec3 light, const Optics& optics = clear()) {
        Scene scene = wall(light);
        if (solid) add(scene, std::move(solid), optics);
        return look<P>(scene).r > 0;
    };
    EXPECT_TRUE(lit(nullptr, {3, 0, 0}));
    EXPECT_FALSE(lit(sphere({1.5, 2, 0}, .25), {3, 0, 0})) << "between";
    EXPECT_FALSE(lit(sphere({1.5, 2, 0}, .25), {3, 0, 0}, emitter({1, 1, 1}))) << "whatever its optics";
    EXPECT_TRUE(lit(sphere({4.5, -2, 0}, .25), {3, 0, 0})) << "behind the light";
    EXPECT_FALSE(lit(sphere({3, 0, 0}, .25), {3, 0, 0})) << "the light is inside";
    EXPECT_FALSE(lit(sphere({3, 0, 0}, .25), {3, 0, 0}, Optics{})) << "inside an opaque one";
    EXPECT_TRUE(lit(cuboid({3, -1, 0}, {2, 2, 2}), {3, 0, 0})) << "on a face that looks to the wall";
    EXPECT_FALSE(lit(cuboid({3, 1, 0}, {2, 2, 2}), {3, 0, 0})) << "on the face that looks away";
    EXPECT_TRUE(lit(nullptr, {3, 3.99, 0})) << "flat";
    Scene on = wall({0, 4, 0}); // in the very point
    EXPECT_EQ(look<P>(on), (Rgb{0, 0, 0}));
    on = wall({1, 4, 0}); // on the wall
    EXPECT_EQ(look<P>(on), (Rgb{0, 0, 0}));
}

TYPED_TEST(KernelsLight, ALightOnABallIsHiddenFromNoPointThatSeesIt)
{
    using P = TypeParam;
    Random random(1);
    int wrong = 0;
    for (int i = 0; i < 300 / P::share; i++) {
        // At a ball's end towards the wall's point (0, 4, 0), at places that float holds exactly.
        const auto grid = [&](double low, double high) { return std::round(64 * uniform(random, low, high)) / 64; };
        const Vec3 c{grid(1, 3), grid(0, 2), grid(-1, 1)}, n = i % 2 ? Vec3{-1, 0, 0} : Vec3{0, 1, 0};
        Scene scene = wall(c + n * .5);
        add(scene, sphere(c, .5), Optics{});
        wrong += look<P>(scene).r > 0 ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0) << "of " << 300 / P::share << " lights on a ball are dark";
}

TYPED_TEST(KernelsLight, SurfacesSeenFromWithinAMediumAreUnlit)
{
    using P = TypeParam;
    Scene scene = wall({3, 0, 0});
    add(scene, complement(plane({0, 3, 0}, {0, 1, 0})), clear(1)); // from y = 3 on, a medium of index 1
    EXPECT_EQ(look<P>(scene).r, 0);
}

TYPED_TEST(KernelsLight, ReflectionAndRefractionAreFiltered)
{
    using P = TypeParam;
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    add(scene, cuboid({0, 4, 0}, {0, 1, 0}), optics_of(.25, 0, 1.5, .5));
    scene.settings.max_hops = 3; // in and out; the branch within ends after its first reflection
    // Head-on: reflected .25; through .5 x .5.
    EXPECT_NEAR(look<P>(scene).r, .25 + .25, 1e-3); // filters are good to 1/2047 of the root
    scene.settings.max_hops = 1;
    EXPECT_EQ(look<P>(scene).r, 0);
    scene.settings.max_hops = 2;
    EXPECT_NEAR(look<P>(scene).r, .25, 5e-4);
    // Fresnel weights both with .04 and .96.
    scene.optics[0] = optics_of(1, 0, 1.5, 1);
    scene.optics[0].fresnel = true;
    EXPECT_NEAR(look<P>(scene).r, .04, 4 * P::u);
    scene.settings.max_hops = 3;
    EXPECT_NEAR(look<P>(scene).r, .04 + .96 * .96, 8 * P::u);
}

TYPED_TEST(KernelsLight, TotalReflectionAddsTheFiltersUpToOne)
{
    using P = TypeParam;
    // Along x through a prism of 45 degrees: in head-on, down by total reflection, out head-on.
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    scene.settings.max_hops = 4;
    const double s = std::sqrt(.5);
    const auto prism = [&](double reflection, double refraction) {
        scene.objects.clear();
        scene.optics.clear();
        add(scene,
            solid(scene::Intersection{
                {plane({-1, 0, 0}, {-1, 0, 0}), plane({0, 0, -1}, {0, 0, -1}), plane({0, 0, 0}, {s, 0, s})}}),
            optics_of(reflection, 0, 1.5, refraction));
        return look<P>(scene, {-2, 0, -.5}, {1, 0, 0}).r;
    };
    // Reflected at once .25; in .5, total .75, out .5. The rest has no hops left.
    EXPECT_NEAR(prism(.25, .5), .25 + .5 * .75 * .5, 2e-3);
    EXPECT_NEAR(prism(0, 1), 1, 2 * P::u);
    EXPECT_NEAR(prism(.5, 1), .5 + 1, 2e-3); // not 1.5
}

TYPED_TEST(KernelsLight, EmissionIsSeenFromOutsideInsideAndBeyond)
{
    using P = TypeParam;
    const Rgb lamp{.25, 1, 0}; // channels that filters hold closely enough
    Scene scene = empty_scene();
    add(scene, sphere({0, 4, 0}, 1), emitter(lamp));
    const auto near = [&](const Rgb& c) { return std::fabs(c.r - lamp.r) < 1e-3 && c.g == lamp.g && c.b == lamp.b; };
    EXPECT_TRUE(near(see<P>(scene)));
    EXPECT_TRUE(near(see<P>(scene, {0, 4, 0}))) << "from inside";
    Scene beyond = empty_scene(); // a lamp that begins where the glass ends
    add(beyond, cuboid({0, 4, 0}, {2, 2, 2}), clear(1.5));
    add(beyond, cuboid({0, 6, 0}, {2, 2, 2}), emitter(lamp));
    EXPECT_TRUE(near(see<P>(beyond))) << "beyond a face in contact";
    Scene within = empty_scene(); // a lamp of lower precedence round a smaller glass
    add(within, cuboid({0, 4, 0}, {1, 1, 1}), clear(1.5));
    add(within, cuboid({0, 4, 0}, {2, 2, 2}), emitter(lamp));
    EXPECT_TRUE(near(see<P>(within))) << "from outside";
    EXPECT_TRUE(near(see<P>(within, {0, 4, 0}))) << "as the medium beyond, from within the glass";
    Optics grey = clear(1);
    grey.passthrough = {.5, .5, .5};
    Scene through = empty_scene();
    add(through, sphere({0, 4, 0}, 1), emitter({1, 1, 1}));
    add(through, cuboid({0, 1, 0}, {0, 2, 0}), grey);
    EXPECT_NEAR(see<P>(through).r, .25, 4 * Float::u) << "through two units of a grey medium";
}

TYPED_TEST(KernelsLight, TheEarlierObjectIsTheMediumWhereTwoOverlap)
{
    using P = TypeParam;
    Stats stats{};
    const SolidPtr a = cuboid({0, 3, 0}, {2, 2, 2}), b = cuboid({0, 4, 0}, {2, 2, 2}); // 2..4 and 3..5
    const auto media = [&](const std::vector<SolidPtr>& solids) {
        std::vector<std::pair<double, u32>> out;
        const Native native(scene_of(solids));
        Path path{{0, 0, 0}, {0, 1, 0}, MEMBER_NONE, false};
        std::vector<u32> inside;
        while (const auto hit = next_hit<P>(native, path, inside, stats)) {
            out.emplace_back(hit->p.y, hit->after);
            inside.clear();
            for (u32 i = 0; i < solids.size(); i++) {
                const Vec3 c = std::get<scene::Cuboid>(solids[i]->node).center;
                if (hit->p.y + .25 > c.y - 1 && hit->p.y + .25 < c.y + 1) inside.push_back(i);
            }
            path = beyond(*hit, path.d);
        }
        return out;
    };
    using Media = std::vector<std::pair<double, u32>>;
    EXPECT_EQ(media({a, b}), (Media{{2, 0}, {4, 1}, {5, vacuum}}));
    EXPECT_EQ(media({b, a}), (Media{{2, 1}, {3, 0}, {5, vacuum}}));
    EXPECT_EQ(media({a, a}), (Media{{2, 0}, {4, vacuum}}));
    EXPECT_EQ(media({b, a, cuboid({0, 6, 0}, {2, 2, 2})}), (Media{{2, 1}, {3, 0}, {5, 2}, {7, vacuum}}));
    expect_sound(stats);
}

TYPED_TEST(KernelsLight, AnOpaqueBodyThatTouchesGlassShowsItsOwnOptics)
{
    using P = TypeParam;
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    add(scene, cuboid({0, 4, 0}, {2, 2, 2}), clear(1.5));
    add(scene, cuboid({0, 6, 0}, {2, 2, 2}), optics_of(.25, 0));
    EXPECT_NEAR(see<P>(scene).r, .25, 5e-4) << "its reflection, on the way back through clear glass";
    // Which is the higher does not matter where they only touch.
    std::swap(scene.objects[0], scene.objects[1]);
    EXPECT_NEAR(see<P>(scene).r, .25, 5e-4);
}

TYPED_TEST(KernelsLight, InAnOpaqueBodyAllIsBlack)
{
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    add(scene, sphere({0, 0, 0}, 1), optics_of(1, 1));
    EXPECT_EQ(see<TypeParam>(scene), (Rgb{0, 0, 0}));
    scene.objects.clear();
    add(scene, sphere({0, 0, 0}, .5), clear(1)); // within a clear core, seen through to the opaque rest
    add(scene, sphere({0, 0, 0}, 1), optics_of(0, 1));
    EXPECT_EQ(see<TypeParam>(scene), (Rgb{0, 0, 0}));
}

TYPED_TEST(KernelsLight, TheSkyIsSeenThroughAMediumOnlyWhereThatIsPerfectlyClear)
{
    using P = TypeParam;
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{.25, .5, .75}};
    Optics haze = clear(1);
    haze.passthrough = {1, .9999, 1};
    add(scene, complement(sphere({0, 100, 0}, 1)), haze);
    EXPECT_EQ(see<P>(scene, {0, 0, 0}, {1, 0, 0}), (Rgb{.25, 0, .75}));
}

TYPED_TEST(KernelsLight, StrongAndWeakPassthroughBothSurvive)
{
    using P = TypeParam;
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    Optics medium = clear(1);
    medium.passthrough = {.01, .9999999, .5};
    add(scene, cuboid({0, 3, 0}, {0, 2, 0}), medium);
    const Rgb c = look<P>(scene);
    // Extinction is a float: exp magnifies its rounding by its own size, 4.6 times 2.
    EXPECT_NEAR(c.r / 1e-4, 1, 12 * Float::u + 12 * P::u);
    EXPECT_NEAR((1 - c.g) / (1 - .9999999 * .9999999), 1, (P::u * 2 / 2e-7) + 2 * Float::u);
    EXPECT_NEAR(c.b / .25, 1, 4 * Float::u + 4 * P::u);
}

TYPED_TEST(KernelsLight, SilentCrossingsCountForTheDistanceInAMedium)
{
    using P = TypeParam;
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    Optics medium = clear(1);
    medium.passthrough = {.5, .5, .5};
    scene.settings.max_hops = 3; // silent crossings cost no hop
    add(scene, cuboid({0, 3, 0}, {0, 2, 0}), medium);
    for (int i = 0; i < 5; i++) add(scene, sphere({0, 3, 0}, .1 * (i + 1)), clear(2));
    EXPECT_NEAR(look<P>(scene).r, .25, 4 * Float::u);
}

TYPED_TEST(KernelsLight, RaysEndByCutoffAndHopsAsTheRuleSays)
{
    using P = TypeParam;
    // Between two lit walls that face each other, and reflect a quarter.
    Scene scene = empty_scene();
    add(scene, plane({0, 1, 0}, {0, -1, 0}), optics_of(.25, 1));
    add(scene, plane({0, -1, 0}, {0, 1, 0}), optics_of(.25, 1));
    scene.lights.push_back({{1, 0, 0}, {1, 1, 1}, {}});
    scene.settings.light_law = scene::LightLaw::lambert;
    const Rgb filter = P::unpack_filter(scene::pack_filter({.25, .25, .25}));
    const double f = filter.r, largest = std::max(f, filter.b);
    const double each = std::sqrt(.5);
    const auto expected = [&](int segments) { return each * (1 - std::pow(f, segments)) / (1 - f); };
    for (const unsigned hops : {1U, 2U, 3U, 19U}) {
        scene.settings.max_hops = hops;
        scene.settings.cutoff = 0;
        EXPECT_NEAR(look<P>(scene).r, expected(static_cast<int>(hops)), 16 * P::u) << hops;
    }
    // A ray goes on while its throughput is not below the cutoff.
    scene.settings.cutoff = largest * largest * .999;
    EXPECT_NEAR(look<P>(scene).r, expected(3), 16 * P::u);
    scene.settings.cutoff = largest * largest * 1.001;
    EXPECT_NEAR(look<P>(scene).r, expected(2), 16 * P::u);
}

TYPED_TEST(KernelsLight, PassthroughIsNoPartOfTheCutoff)
{
    using P = TypeParam;
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    Optics dark = clear(1);
    dark.passthrough = {1e-4, 1e-4, 1e-4};
    add(scene, cuboid({0, 3, 0}, {0, 1, 0}), dark);
    add(scene, plane({0, 6, 0}, {0, -1, 0}), mirror());
    EXPECT_NEAR(look<P>(scene).r / 1e-8, 1, 32 * (Float::u + P::u));
}

TYPED_TEST(KernelsLight, ByTheRuleOfRanksAMuchDarkerMediumOutsideShowsItsOptics)
{
    using P = TypeParam;
    // Ice in ink: the ink's rank is under half of the ice's.
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{0, 0, 0}};
    Optics ice = optics_of(.25, 0, 1, 1), ink = optics_of(0, 0, 1, .25);
    ink.passthrough = {.25, .25, .25};
    ink.refraction = {.25, .25, .25};
    add(scene, sphere({0, 4, 0}, 1), ice);
    add(scene, complement(sphere({0, 0, 0}, 1000)), emitter({1, 1, 1}));
    add(scene, sphere({0, 4, 0}, 100), ink);
    scene.settings.max_hops = 2;
    scene.settings.media_rule = scene::MediaRule::nearest;
    const auto reflects = [&] {
        View view;
        view.width = view.height = 1;
        return render<P>(scene, view).stats[STAT_REFLECTED] > 0;
    };
    EXPECT_TRUE(reflects());
    scene.settings.media_rule = scene::MediaRule::rank;
    EXPECT_FALSE(reflects()) << "the ink reflects nothing";
    scene.optics[2].passthrough = scene.optics[2].refraction = {1, 1, 1};
    EXPECT_TRUE(reflects()) << "not under half";
}

} // namespace
} // namespace clucida::test
