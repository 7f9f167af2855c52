// From a scene to buffers: needs, starts, precedence, places, the memory report.
#include "native_scene.h"
#include "scene/report.h"

#include <algorithm>
#include <fmt/format.h>

namespace clucida::test {
namespace {

using namespace scene;

std::uint32_t features(const Scene& scene, const View& view = {})
{
    return compile(scene, view).needs.features;
}

TEST(CompileScene, ASceneNeedsWhatItHasAndNothingElse)
{
    Scene scene = empty_scene();
    EXPECT_EQ(features(scene), 0U);
    const auto with = [](SolidPtr s, const Optics& optics = Optics{}) {
        Scene scene = empty_scene();
        test::add(scene, std::move(s), optics);
        return features(scene);
    };
    const SolidPtr ball = test::sphere({0, 5, 0}, 1);
    EXPECT_EQ(with(test::plane({0, 5, 0}, {0, 1, 0})), feature_plane);
    EXPECT_EQ(with(ball), feature_sphere);
    EXPECT_EQ(with(cuboid({0, 5, 0}, {1, 1, 1})), feature_plane);
    EXPECT_EQ(with(solid(Cylinder{{0, 5, 0}, {1, 0, 0}})), feature_quadric);
    EXPECT_EQ(with(solid(FreeQuadric{{1, 2, 3, 0, 0, 0, 0, 0, 0, -1}})), feature_quadric);
    EXPECT_EQ(with(solid(FreeQuadric{{0, 0, 0, 0, 0, 0, 0, 0, 1, -1}})), feature_plane);
    EXPECT_EQ(with(solid(Torus{{0, 5, 0}, {1, 0, 0}, 1, .25})), feature_torus | feature_groups | feature_program);
    EXPECT_EQ(with(solid(Difference{ball, test::sphere({1, 5, 0}, 1)})), feature_sphere | feature_groups);
    EXPECT_EQ(with(solid(Union{{ball, test::sphere({1, 5, 0}, 1)}})),
              feature_sphere | feature_groups | feature_program);
    EXPECT_EQ(with(ball, clear(1.5)), feature_sphere | feature_transparent);
    EXPECT_EQ(with(ball, emitter({1, 1, 1})), feature_sphere | feature_emission);
    EXPECT_EQ(with(ball, mirror()), feature_sphere);
    Optics optics = clear(1.5);
    optics.fresnel = true;
    EXPECT_EQ(with(ball, optics), feature_sphere | feature_transparent | feature_fresnel);
    optics = clear(1);
    optics.passthrough = {1, .5, 1};
    EXPECT_EQ(with(ball, optics), feature_sphere | feature_transparent | feature_extinction);
    optics.index = 0;
    EXPECT_EQ(with(ball, optics), feature_sphere) << "what is opaque lets nothing pass";
    scene.optics.push_back(clear(1.5));
    EXPECT_EQ(features(scene), 0U) << "optics that no object has";
}

TEST(CompileScene, LightsSkiesAndRulesAreNeeds)
{
    Scene scene = empty_scene();
    scene.settings.light_law = LightLaw::lambert;
    EXPECT_EQ(features(scene), 0U) << "a law without a light";
    scene.lights.push_back({{1, 2, 3}, {1, 1, 1}, {}});
    EXPECT_EQ(features(scene), feature_light_lambert);
    scene.settings.light_law = LightLaw::paper;
    EXPECT_EQ(features(scene), feature_light_paper);
    scene.settings.light_law = LightLaw::inverse_square;
    EXPECT_EQ(features(scene), feature_light_inverse_square);
    scene.lights.clear();
    scene.sky = SkyGradient{};
    EXPECT_EQ(features(scene), feature_sky_gradient);
    scene.sky = SkyRgb{};
    EXPECT_EQ(features(scene), feature_sky_rgb);
    scene.sky = SkyHsv{};
    EXPECT_EQ(features(scene), feature_sky_hsv);
    scene.sky = SkyColor{};
    scene.settings.media_rule = MediaRule::rank;
    EXPECT_EQ(features(scene), feature_media_rank);
    scene.settings.media_rule = MediaRule::nearest;
    View view;
    view.as_original = AsOriginal::gun;
    EXPECT_EQ(features(scene, view), feature_as_gun);
    view.as_original = AsOriginal::rayt;
    EXPECT_EQ(features(scene, view), feature_as_rayt);
}

TEST(CompileScene, CapacitiesSuffice)
{
    Scene scene = empty_scene();
    EXPECT_EQ(compile(scene, {}).needs.stack, 0U);
    for (int i = 0; i < 5; i++) test::add(scene, test::sphere({10. * i, 5, 0}, 1), clear(1.5));
    Compiled compiled = compile(scene, {});
    EXPECT_EQ(compiled.interior_bound, 1U) << "they lie apart";
    EXPECT_GE(compiled.needs.stack, 18U);
    for (int i = 0; i < 5; i++) test::add(scene, test::sphere({0, 5, 0}, 2. + i), clear(1.5));
    compiled = compile(scene, {});
    EXPECT_GE(compiled.interior_bound, 6U);
    EXPECT_LE(compiled.interior_bound, 10U);
    EXPECT_GE(compiled.needs.interior, compiled.interior_bound);
    View view;
    view.max_hops = 1;
    EXPECT_EQ(compile(scene, view).needs.stack, 1U);
}

TEST(CompileScene, TheInteriorBoundIsNeverTooSmall)
{
    Random random(1);
    for (int i = 0; i < 100; i++) {
        Scene scene = empty_scene();
        std::vector<std::pair<Vec3, double>> balls;
        for (int k = 0; k < 20; k++) {
            balls.emplace_back(random_in_box(random, 3), uniform(random, .2, 2));
            test::add(scene, test::sphere(balls.back().first, balls.back().second), clear());
        }
        const std::size_t bound = compile(scene, {}).interior_bound;
        for (int k = 0; k < 200; k++) {
            const Vec3 p = random_in_box(random, 3);
            const auto holds = [&](const auto& b) { return length(p - b.first) < b.second; };
            ASSERT_LE(static_cast<std::size_t>(std::ranges::count_if(balls, holds)), bound);
        }
    }
}

TEST(CompileScene, ObjectsKeepTheirOrderAndWhatBelongsToThem)
{
    Scene scene = empty_scene();
    for (int i = 0; i < 50; i++) test::add(scene, test::sphere({1. * (i * 7 % 50), 5, 0}, .25), mirror());
    for (int i = 0; i < 50; i++) scene.objects[i].name = fmt::format("ball_{}", i);
    std::swap(scene.objects[3].optics, scene.objects[4].optics);
    const Native native(scene);
    const auto objects = native.items<LayoutObject>(BUFFER_OBJECTS);
    ASSERT_EQ(objects.size(), 50U);
    for (int i = 0; i < 50; i++) {
        EXPECT_EQ(objects[i].center[0], i * 7 % 50);
        EXPECT_EQ(objects[i].optics, scene.objects[i].optics);
        EXPECT_EQ(objects[i].texture, TEXTURE_NONE);
    }
}

TEST(CompileScene, StartsCountEveryObjectThatHoldsTheEye)
{
    Random random(2);
    unsigned held = 0, counted = 0;
    for (int i = 0; i < 300; i++) {
        const Vec3 eye = random_in_box(random, 5);
        Scene scene = empty_scene();
        scene.observer = Pinhole{eye, eye + Vec3{0, 1, 0}, {0, 0, 1}, 45};
        u32 holders = 0;
        for (u32 k = 0; k < 12; k++) {
            const Vec3 c = random_in_box(random, 5), n = random_direction(random);
            const double r = uniform(random, .5, 6);
            bool inside = length(eye - c) < r;
            SolidPtr s = test::sphere(c, r);
            if (k % 4 == 1) {
                s = complement(s);
                inside = !inside;
            } else if (k % 4 == 2) {
                s = test::plane(c, n);
                inside = dot(eye - c, n) < 0;
            } else if (k % 4 == 3) {
                s = solid(Difference{s, test::plane(c, n)});
                inside = inside && !(dot(eye - c, n) < 0);
            }
            test::add(scene, s, clear());
            if (inside) holders++;
        }
        const Native native(scene);
        const u32 starts = native.items<LayoutFrame>(BUFFER_FRAME)[0].start_count;
        ASSERT_GE(starts, holders);
        held += holders;
        counted += starts;
    }
    EXPECT_GT(held, 500U);
    EXPECT_LT(counted, held + held / 100) << "nor many more";
}

TEST(CompileScene, AnEyeOnABoundaryCountsItsObject)
{
    Scene scene = empty_scene();
    test::add(scene, cuboid({0, 1, 0}, {2, 2, 2}), clear());
    test::add(scene, cuboid({0, -1, 0}, {2, 2, 2}), clear());
    test::add(scene, cuboid({0, 5, 0}, {2, 2, 2}), clear());
    const Native native(scene);
    EXPECT_EQ(native.items<LayoutFrame>(BUFFER_FRAME)[0].start_count, 2U);
}

TEST(CompileScene, TheMemoryReportAddsUp)
{
    Random random(3);
    Scene scene = empty_scene();
    for (int i = 0; i < 40; i++) {
        const SolidPtr ball = test::sphere(random_in_box(random, 5), 1), tube = solid(Cylinder{{1, 2, 3}, {0, 0, 1}});
        const SolidPtr box = cuboid(random_in_box(random, 5), {1, 1, 1});
        test::add(scene,
                  i % 3 == 0   ? solid(Union{{ball, box, solid(Difference{tube, box})}})
                  : i % 3 == 1 ? solid(Intersection{{ball, tube, box}})
                               : complement(ball),
                  clear());
    }
    test::add(scene, solid(Torus{{1, 2, 3}, {0, 0, 1}, 2, .5}), clear());
    scene.objects[3].name = "three";
    const Compiled compiled = compile(scene, {});
    ObjectReport sum;
    std::size_t stored = 0;
    const std::vector<ObjectReport> objects = report_objects(scene, compiled.buffers);
    ASSERT_EQ(objects.size(), 41U);
    EXPECT_EQ(objects[3].name, "three");
    EXPECT_EQ(objects[40].tori, 1U) << "its two intervals are one torus";
    for (const ObjectReport& object : objects) {
        sum.bytes += object.bytes;
        sum.planes += object.planes;
        sum.spheres += object.spheres;
        sum.quadrics += object.quadrics;
    }
    const auto bytes_of = [&](LayoutBuffer buffer) { return compiled.buffers.bytes[buffer].size(); };
    for (const auto buffer : {BUFFER_OBJECTS, BUFFER_GROUPS, BUFFER_MEMBERS, BUFFER_PROGRAMS, BUFFER_PLANES,
                              BUFFER_BLOCKS, BUFFER_SPHERES, BUFFER_QUADRICS, BUFFER_TORI})
        stored += bytes_of(buffer);
    EXPECT_EQ(sum.bytes, stored);
    EXPECT_EQ(sum.planes * sizeof(LayoutPlane), bytes_of(BUFFER_PLANES));
    EXPECT_EQ(sum.spheres * sizeof(LayoutSphere), bytes_of(BUFFER_SPHERES));
    EXPECT_EQ(sum.quadrics * sizeof(LayoutQuadric), bytes_of(BUFFER_QUADRICS));
}

TEST(CompileScene, AFarObjectKeepsItsPlaceToTheRoundingOfItsSize)
{
    Random random(4);
    for (int i = 0; i < 200; i++) {
        const Vec3 c = random_direction(random) * log_uniform(random, 1, 1e6), eye = random_in_box(random, 1e6);
        Scene scene = empty_scene();
        scene.observer = Pinhole{eye, eye + Vec3{0, 1, 0}, {0, 0, 1}, 45};
        const SolidPtr other = test::sphere(c + random_in_box(random, 1), 1);
        test::add(scene, solid(Union{{test::sphere(c, 1), other}}), clear());
        const Native native(scene);
        const auto& object = native.items<LayoutObject>(BUFFER_OBJECTS)[0];
        const auto balls = native.items<LayoutSphere>(BUFFER_SPHERES);
        const Vec3 expected[]{c - eye, std::get<Sphere>(other->node).center - eye};
        for (int k = 0; k < 2; k++) {
            const Vec3 got{object.center[0] + static_cast<double>(balls[k].c[0]),
                           object.center[1] + static_cast<double>(balls[k].c[1]),
                           object.center[2] + static_cast<double>(balls[k].c[2])};
            // The parts are of size 2; the difference of two doubles near 1e6 leaves 1e-10 itself.
            ASSERT_LE(length(got - expected[k]), 2 * 4 * Float::u + 1e-9) << i;
        }
    }
}

TEST(CompileScene, AViewReplacesHopsAndCutoff)
{
    Scene scene = empty_scene();
    scene.settings.max_hops = 7;
    scene.settings.cutoff = .5;
    View view;
    EXPECT_EQ(Native(scene, view).items<LayoutFrame>(BUFFER_FRAME)[0].max_hops, 7U);
    view.max_hops = 3;
    view.cutoff = .25;
    const Native native(scene, view);
    EXPECT_EQ(native.items<LayoutFrame>(BUFFER_FRAME)[0].max_hops, 3U);
    EXPECT_EQ(native.items<LayoutFrame>(BUFFER_FRAME)[0].cutoff, .25F);
}

} // namespace
} // namespace clucida::test
