// Whole pictures that must be equal: scenes scaled, moved, mirrored, permuted, cut into flush pieces, or invisible.
#include "native_scene.h"

#include <fmt/format.h>

namespace clucida::test {
namespace {

template <typename P>
class KernelsImages : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsImages, Machines, MachineNames);

View view_of(unsigned width, unsigned height)
{
    View view;
    view.width = width;
    view.height = height;
    return view;
}
const View small = view_of(64, 48);

/// "@[x, y, z]" becomes [s*(x), s*(y), s*(z)], "+[x, y, z]" has m added to each.
std::string with_vectors(std::string text)
{
    for (std::size_t at = 0; (at = text.find_first_of("@+", at)) != std::string::npos;) {
        if (text[at + 1] != '[') {
            at++;
            continue;
        }
        const char* m = text[at] == '+' ? " + m" : "";
        const std::size_t a = text.find(',', at), b = text.find(',', a + 1), end = text.find(']', b);
        const auto component = [&](std::size_t from, std::size_t to) {
            return fmt::format("s*({}){}", text.substr(from, to - from), m);
        };
        const std::string vector =
            fmt::format("[{}, {}, {}]", component(at + 2, a), component(a + 1, b), component(b + 1, end));
        text.replace(at, end + 1 - at, vector);
    }
    return text;
}

/// Mirrors, glass and lit chalk; all lengths times s, all moved by m along x, y and z; x mirrored if flip is -1.
std::string still_life(double s, double m, int flip)
{
    return fmt::format("let s = {}\nlet f = {}\nlet m = {}", s, flip, m) + with_vectors(R"(
        settings { hops 8 }
        observer { eye +[0, -6, 2]; look +[0, 0, 0.5]; fov 40 }
        sky gradient { low 0.1; middle [0.5, 0.6, 0.8]; high [0.1, 0.2, 0.6] }
        light { point +[f*4, -4, 8] }
        optics glass { reflection 0.1; index 1.5; refraction 0.9 }
        optics mirror { reflection 0.9 }
        optics chalk { absorption [0.9, 0.7, 0.5]; reflection 0.1 }
        object { solid sphere(+[f*0.5, -1, 0.75], s*0.7) - sphere(+[f*0.5, -1, 1.2], s*0.5); optics glass }
        object { solid cuboid(+[f*-1, 0, 0.5], [0, 0, 1], [2, f*1, 0], @[1, 0.75, 1]); optics chalk }
        object { solid cone(+[f*1.5, 1, 1.5], [0, 0, 2]) & plane(+[0, 0, 1.5], [0, 0, 1]); optics mirror }
        object { solid cylinder(+[f*0.25, 2, 0], @[0, 0, 0.5]) & plane(+[0, 0, 2], [0, 0, 1]) &
                       plane(+[0, 0, 0], [0, 0, -1]); optics chalk }
        object { solid plane(+[0, 0, 0], [0, 0, 1]); optics chalk })");
}

TYPED_TEST(KernelsImages, AScaledSceneIsTheSamePicture)
{
    using P = TypeParam;
    const Image one = render<P>(parse(still_life(1, 0, 1)), small);
    expect_sound(one.stats);
    for (int k = -13; k <= 20; k += P::share == 1 ? 1 : 11) {
        const Image scaled = render<P>(parse(still_life(std::ldexp(1, k), 0, 1)), small);
        EXPECT_TRUE(same_bits(one, scaled)) << "by 2^" << k << ": RMSE " << rmse(one, scaled);
        EXPECT_EQ(one.stats, scaled.stats) << "events by 2^" << k;
        expect_sound(scaled.stats);
    }
}

TYPED_TEST(KernelsImages, AMovedSceneIsTheSamePicture)
{
    const Image here = render<TypeParam>(parse(still_life(1, 0, 1)), small);
    const Image there = render<TypeParam>(parse(still_life(1, 1e5, 1)), small);
    // What double keeps of lengths at 1e5 is 1e-11: only float's rounding of slightly other numbers remains.
    EXPECT_LE(rmse(here, there), 2e-6);
    Measured("rmse_itself").see(rmse(here, there));
    expect_sound(there.stats);
}

bool nearly(const Rgb& a, const Rgb& b, double bound)
{
    const auto near = [&](double x, double y) { return std::fabs(x - y) <= bound * std::fabs(y); };
    return near(a.r, b.r) && near(a.g, b.g) && near(a.b, b.b);
}

TYPED_TEST(KernelsImages, AMirroredSceneIsTheMirroredPicture)
{
    const Image left = render<TypeParam>(parse(still_life(1, 0, 1)), small);
    const Image right = render<TypeParam>(parse(still_life(1, 0, -1)), small);
    const double roundings = TypeParam::sum_roundings * Float::u;
    unsigned different = 0;
    for (unsigned j = 0; j < small.height; j++)
        for (unsigned i = 0; i < small.width; i++)
            different += nearly(left.at(i, j), right.at(small.width - 1 - i, j), roundings) ? 0 : 1;
    EXPECT_EQ(different, 0U) << "pixels of " << small.width * small.height;
}

TYPED_TEST(KernelsImages, ThePictureDoesNotDependOnTheAxesNames)
{
    const auto scene = [](const char* names) {
        std::string text = R"(settings { hops 8 }
            observer { eye [0, -6, 2]; look [0, 0, 0.5]; up [0, 0, 1]; fov 40 }
            sky color [0.5, 0.6, 0.8]
            light { point [4, -4, 8] }
            object { solid sphere([0.5, -1, 0.75], 0.75); optics { reflection 0.1; index 1.5; refraction 0.9 } }
            object { solid cylinder([0.25, 2, 0], [0, 0, 0.5]); optics { reflection 0.5; absorption 0.5 } }
            object { solid plane([0, 0, 0], [0, 0, 1]); optics { absorption [0.9, 0.7, 0.5] } })";
        if (names[0] == 'x') return parse(text);
        // (x, y, z) to (z, x, y) in every vector but the colors.
        std::string out;
        for (std::size_t i = 0; i < text.size();) {
            const std::size_t open = text.find('[', i);
            if (open == std::string::npos) return parse(out + text.substr(i));
            const std::size_t close = text.find(']', open), a = text.find(',', open), b = text.find(',', a + 1);
            const bool color = text.find("color", i) < open || text.find("absorption", i) < open;
            out += text.substr(i, open - i);
            const std::string x = text.substr(open + 1, a - open - 1), y = text.substr(a + 1, b - a - 1),
                              z = text.substr(b + 1, close - b - 1);
            out += color ? fmt::format("[{},{},{}]", x, y, z) : fmt::format("[{},{},{}]", z, x, y);
            i = close + 1;
        }
        return parse(out);
    };
    const Image image = render<TypeParam>(scene("xyz"), small), turned = render<TypeParam>(scene("zxy"), small);
    // Sums of three are rounded in another order: some units, over 8 hops; but no other events.
    EXPECT_LE(rmse(image, turned), 64 * TypeParam::u);
    Measured("rmse_itself").see(rmse(image, turned));
    for (const auto stat : {STAT_RAYS, STAT_REFLECTED, STAT_REFRACTED, STAT_SHADOW})
        EXPECT_EQ(image.stats[stat], turned.stats[stat]);
}

TYPED_TEST(KernelsImages, TheOrderOfDisjointObjectsDoesNotMatter)
{
    Random random(1);
    std::vector<std::pair<Vec3, double>> balls;
    for (int i = 0; i < 27; i++)
        balls.push_back({{i % 3 - 1. + uniform(random, -.1, .1), 6. + i / 3 % 3, i / 9 - 1.}, uniform(random, .2, .4)});
    const auto scene = [&](bool turned) {
        Scene scene = empty_scene();
        scene.sky = scene::SkyRgb{};
        scene.lights.push_back({{3, 0, 3}, {1, 1, 1}, {}});
        scene.settings.max_hops = 8;
        for (std::size_t i = 0; i < balls.size(); i++) {
            const std::size_t k = turned ? balls.size() - 1 - i : i;
            Optics optics = clear(k % 2 ? 1.5 : 0);
            optics.reflection = {.5, .5, .5};
            optics.absorption = {.25, .5, .75};
            add(scene, sphere(balls[k].first, balls[k].second), optics);
        }
        return scene;
    };
    const Image a = render<TypeParam>(scene(false), small), b = render<TypeParam>(scene(true), small);
    EXPECT_TRUE(same_bits(a, b)) << rmse(a, b);
    EXPECT_GT(a.stats[STAT_REFRACTED], 1000U);
    expect_sound(a.stats);
}

/// The sky alone, and behind invisible objects.
template <typename P>
void expect_invisible(const std::vector<SolidPtr>& solids, Vec3 eye = {0, 0, 0})
{
    Scene scene = scene_of(solids);
    scene.sky = scene::SkyRgb{};
    scene.observer = scene::Pinhole{eye, eye + Vec3{0, 1, .125}, {0, 0, 1}, 60};
    const Image with = render<P>(scene, small);
    scene.objects.clear();
    const Image without = render<P>(scene, small);
    EXPECT_TRUE(same_bits(with, without)) << rmse(with, without);
    expect_sound(with.stats);
}

TYPED_TEST(KernelsImages, AnObjectOfTheSurroundingIndexCannotBeSeen)
{
    using P = TypeParam;
    expect_invisible<P>({sphere({0, 3, 0}, 1)});
    expect_invisible<P>({cuboid({.5, 3, 0}, {1, 1, 1}), solid(scene::Cone{{0, 4, 0}, {1, 2, 3}}),
                         solid(scene::Saddle{{0, 4, 0}, {1, 2, 3}, {1, 0, 0}})});
    expect_invisible<P>({solid(scene::Difference{sphere({0, 3, 0}, 1), cuboid({0, 3, .5}, {1, 1, 1})}),
                         complement(solid(scene::Cylinder{{0, 3, 0}, {0, 0, 1}}))});
}

TYPED_TEST(KernelsImages, ACameraWithinOrOnTheEdgeOfInvisibleGlassSeesTheSky)
{
    using P = TypeParam;
    expect_invisible<P>({sphere({0, 0, 0}, 1), sphere({0, 0, 0}, 2), cuboid({0, 0, 0}, {5, 6, 7})});
    expect_invisible<P>({complement(sphere({0, 5, 0}, 1)), complement(solid(scene::Cone{{0, 5, 0}, {0, 0, 1}}))});
    expect_invisible<P>({cuboid({0, 1, 0}, {2, 2, 2})});                                     // on a face
    expect_invisible<P>({cuboid({0, 0, 1}, {2, 2, 2})}, {0, 0, 0});                          // on the lower face
    expect_invisible<P>({cuboid({1, 1, 1}, {2, 2, 2})});                                     // at a corner
    expect_invisible<P>({sphere({0, 1, 0}, 1)});                                             // on a ball
    expect_invisible<P>({solid(scene::Cone{{0, 0, 0}, {0, 0, 1}})});                         // at an apex
    expect_invisible<P>({solid(scene::Cone{{0, 0, 0}, {0, 1, 0}})});                         // at an apex, looking in
    expect_invisible<P>({solid(scene::Paraboloid{{0, 0, 0}, {0, .5, 0}})});                  // at a vertex
    expect_invisible<P>({sphere({0, 1, 0}, 1), sphere({0, 2, 0}, 2), sphere({0, 3, 0}, 3)}); // all touch here
    expect_invisible<P>({cuboid({10.1, 21.2, 30.3}, {2, 2, 2})}, {10.1, 20.2, 30.3});        // on a face, elsewhere
}

TYPED_TEST(KernelsImages, ACameraOnAnOpaqueFaceSeesOutwardsOnly)
{
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    add(scene, cuboid({0, 0, -1}, {2, 2, 2}), Optics{});
    const Image image = render<TypeParam>(scene, small); // looks along the face: half of it is the box
    for (unsigned j = 0; j < small.height; j++)
        for (unsigned i = 0; i < small.width; i += 7)
            EXPECT_EQ(image.at(i, j).r, j < small.height / 2 ? 1 : 0) << i << ' ' << j;
    expect_sound(image.stats);
}

TYPED_TEST(KernelsImages, FlushBlocksOfOneIndexAreOneBlock)
{
    const auto scene = [](int pieces) {
        Scene scene = empty_scene();
        scene.sky = scene::SkyRgb{};
        scene.observer = scene::Pinhole{{1.3, -3, .7}, {0, 0, 0}, {0, 0, 1}, 40};
        const double width = 2.0 / pieces;
        for (int i = 0; i < pieces; i++) add(scene, cuboid({-1 + width * (i + .5), 0, 0}, {width, 1, 1}), clear(1.5));
        return scene;
    };
    const Image one = render<TypeParam>(scene(1), small), ten = render<TypeParam>(scene(10), small);
    expect_sound(ten.stats);
    // Silent crossings move a ray by a unit each; total reflections inside make that some more.
    EXPECT_LE(rmse(one, ten), 2e-6);
    Measured("rmse_itself").see(rmse(one, ten));
}

TYPED_TEST(KernelsImages, BetweenFlushBlocksOfDifferentIndexIsNoVacuum)
{
    using P = TypeParam;
    Random random(2);
    Stats stats{};
    unsigned vacuums = 0, rays = 0;
    for (const double at : {0., .1, 7.3, 1234.5}) {
        Scene scene = empty_scene();
        for (int i = 0; i < 10; i++) add(scene, cuboid({at + .2 * (i + .5), 0, 0}, {.2, 1, 1}), clear(1.1 + .05 * i));
        const Native native(scene);
        for (int i = 0; i < 1000 / P::share; i++) {
            const Vec3 d = scene::unit({1, uniform(random, -.1, .1), uniform(random, -.1, .1)});
            Path path{Vec3{at - .5, uniform(random, -.2, .2), uniform(random, -.2, .2)}, d, MEMBER_NONE, false};
            std::vector<u32> inside;
            rays++;
            for (int k = 0; k < 11; k++) {
                const auto hit = next_hit<P>(native, path, inside, stats);
                const u32 before = k == 0 ? vacuum : k - 1, after = k == 10 ? vacuum : k;
                if (!hit || hit->before != before || hit->after != after) {
                    vacuums++;
                    break;
                }
                inside.assign(k == 10 ? 0 : 1, after);
                path = beyond(*hit, d);
            }
        }
    }
    EXPECT_EQ(vacuums, 0U) << "of " << rays << " rays";
    expect_sound(stats);
}

TYPED_TEST(KernelsImages, WhereAStudMeetsFlushBlocksIsNoVacuum)
{
    using P = TypeParam;
    Random random(4);
    Stats stats{};
    unsigned vacuums = 0, parted = 0, rays = 0;
    for (const double away : {0., 3., 40.}) {
        // The stud of the lower block lies within the upper block, whose lower face is flush with the lower's upper.
        Scene scene = empty_scene();
        const Vec3 c{.7 * away, -.6 * away, .3 * away};
        const SolidPtr stud = solid(
            scene::Intersection{{solid(scene::Cylinder{c, {0, 0, .3}}), cuboid(c + Vec3{0, 0, -.4}, {2, 2, 1.2})}});
        add(scene, solid(scene::Union{{cuboid(c + Vec3{0, 0, -1}, {2, 2, 2}), stud}}), clear(1.3));
        add(scene, cuboid(c + Vec3{0, 0, 1}, {2, 2, 2}), clear(1.4));
        const Native native(scene);
        for (int i = 0; i < 20000 / P::share; i++) {
            const double angle = uniform(random, 0, 6.28), height = log_uniform(random, 1e-9, 1e-2);
            const Vec3 out{std::cos(angle), std::sin(angle), 0}, across{-out.y, out.x, 0};
            const Vec3 d =
                scene::unit(out + across * uniform(random, -2, 2) + Vec3{0, 0, -log_uniform(random, .05, 1)});
            const Vec3 start = c + out * .3 + Vec3{0, 0, height} - d * .1;
            Path path{start, d, MEMBER_NONE, false};
            std::vector<u32> inside{0, 1};
            rays++;
            auto hit = next_hit<P>(native, path, inside, stats);
            if (hit && hit->after == 1) {
                parted++;
                inside = {1};
                path = beyond(*hit, d);
                const auto next = next_hit<P>(native, path, inside, stats);
                if (!next || next->after != 0) vacuums++;
            } else if (!hit || scene::length(hit->p - start) < .5) {
                vacuums++;
            }
        }
    }
    EXPECT_EQ(vacuums, 0U) << "of " << rays << " rays";
    EXPECT_GT(parted, rays / 4);
    EXPECT_LT(parted, rays);
    expect_sound(stats);
}

TYPED_TEST(KernelsImages, NothingLeaksThroughEdgesAndCorners)
{
    using P = TypeParam;
    Random random(3);
    Stats stats{};
    // A lamp in a black box, seen from outside; and a white world round a black room, seen from inside.
    Scene outside = empty_scene(), inside = empty_scene();
    inside.sky = scene::SkyColor{{1, 1, 1}};
    const SolidPtr box = solid(scene::Cuboid{{0, 0, 0}, {.3, -.2, .9}, {1, .4, 0}, {2, 2, 2}});
    add(outside, box, Optics{});
    add(outside, sphere({0, 0, 0}, .99), emitter({1, 1, 1}));
    add(inside, complement(box), Optics{});
    const Native closed(outside), room(inside);
    const Vec3 z = scene::unit({.3, -.2, .9}), x = scene::unit(Vec3{1, .4, 0} - z * scene::dot({1, .4, 0}, z)),
               y = scene::cross(z, x);
    for (int i = 0; i < 20000 / P::share; i++) {
        const auto side = [&] { return random() % 2 ? 1. : -1.; };
        const double along = i % 4 == 0 ? side() : uniform(random, -1, 1); // a corner, or somewhere on an edge
        const Vec3 edge = (i % 3 == 0   ? x * along + y * side() + z * side()
                           : i % 3 == 1 ? x * side() + y * along + z * side()
                                        : x * side() + y * side() + z * along);
        const Vec3 far = random_direction(random) * log_uniform(random, 3, 1000), near = random_in_box(random, .5);
        ASSERT_EQ(trace<P>(closed, far, scene::unit(edge - far), stats), (Rgb{0, 0, 0})) << i;
        // native trace starts outside of all: the room's complement is left out of the eye's interior there too.
        ASSERT_EQ(trace<P>(room, near, scene::unit(edge - near), stats), (Rgb{0, 0, 0})) << i;
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsImages, AThousandThinSlabsAbsorbAsOne)
{
    using P = TypeParam;
    Stats stats{};
    const auto slabs = [](int count) {
        Scene scene = empty_scene();
        scene.sky = scene::SkyColor{{1, 1, 1}};
        scene.settings.max_hops = 1100;
        Optics grey = clear(1);
        grey.passthrough = {.5, .25, .999};
        for (int i = 0; i < count; i++) add(scene, cuboid({0, 2 + (i + .5) / count, 0}, {0, 1.0 / count, 0}), grey);
        return scene;
    };
    const Rgb one = trace<P>(Native(slabs(1)), {0, 0, 0}, {0, 1, 0}, stats);
    EXPECT_NEAR(one.r, .5, 4 * P::u + Float::u); // extinctions are floats in the buffers
    EXPECT_NEAR(one.g, .25, 4 * P::u + Float::u);
    EXPECT_NEAR(one.b, .999, 4 * P::u + Float::u);
    const Rgb many = trace<P>(Native(slabs(1000)), {0, 0, 0}, {0, 1, 0}, stats);
    // A thousand products, of segments whose ends at 3 are rounded to float.
    const double tolerance = 1000 * 2 * (P::u + Float::u);
    EXPECT_NEAR(many.r / one.r, 1, tolerance);
    EXPECT_NEAR(many.g / one.g, 1, tolerance);
    EXPECT_NEAR(many.b / one.b, 1, tolerance);
    Measured worst("relative_in_units_of_float");
    for (const double ratio : {many.r / one.r, many.g / one.g, many.b / one.b}) worst.see((ratio - 1) / Float::u);
    expect_sound(stats);
}

TYPED_TEST(KernelsImages, ALosslessSceneInAWhiteSkyIsWhite)
{
    using P = TypeParam;
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    scene.settings.max_hops = 40;
    scene.settings.cutoff = 1. / 4096;
    Optics glass = clear(1.5);
    glass.reflection = {1, 1, 1};
    glass.fresnel = true;
    add(scene, sphere({-.5, 4, 0}, 1), glass);
    add(scene, cuboid({1, 4, .25}, {1, 1, 1}), glass);
    add(scene, plane({0, 0, -1.5}, {0, 0, 1}), mirror());
    const Image image = render<P>(scene, small);
    expect_sound(image.stats);
    double sum = 0;
    for (unsigned j = 0; j < small.height; j++) {
        for (unsigned i = 0; i < small.width; i++) {
            sum += 1 - static_cast<double>(image.at(i, j).r);
            EXPECT_LE(image.at(i, j).r, 1 + 100 * Float::u);
        }
    }
    // What is missing is what the statistics report as truncated, each branch's rounded down to 2^-16.
    const double truncated = image.stats[STAT_TRUNCATED] * 0x1p-16;
    const double branches = image.stats[STAT_CUT_BRANCHES] + image.stats[STAT_HOP_BRANCHES];
    EXPECT_GE(sum, truncated - 1e-5 * small.width * small.height);
    EXPECT_LE(sum, truncated + branches * 0x1p-16 + 1e-5 * small.width * small.height);
}

} // namespace
} // namespace clucida::test
