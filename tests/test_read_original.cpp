#include "scene/write.h"
#include "test_read_support.h"

#include <cmath>

namespace clucida::scene::test {
namespace {

void expect_near(const Vec3& a, const Vec3& b)
{
    EXPECT_NEAR(a.x, b.x, 1e-15);
    EXPECT_NEAR(a.y, b.y, 1e-15);
    EXPECT_NEAR(a.z, b.z, 1e-15);
}

TEST(ReadGun, AllOfTheLanguageIsUnderstood)
{
    const Scene scene = read(data_text("full.gun"), Format::gun);
    EXPECT_EQ(scene.observer, Observer(Window{{0, -4, 1}, {0, 0, 0}, {1, 0, 0}, {0, 0, -1}}));
    EXPECT_EQ(scene.settings, Settings{});
    EXPECT_EQ(scene.sky, Sky(SkyColor{{.1, .2, .3}}));
    ASSERT_EQ(scene.objects.size(), 6U);
    EXPECT_EQ(std::get<Sphere>(scene.objects[0].solid->node), (Sphere{{0, 0, 1}, 1}));
    const auto& members = std::get<Intersection>(scene.objects[1].solid->node).of;
    ASSERT_EQ(members.size(), 3U);
    EXPECT_EQ(std::get<Sphere>(std::get<Complement>(members[0]->node).of->node).radius, .5);
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.lights[1].color, (Rgb{2, .5, 0}));
}

TEST(ReadGun, IdenticalOpticsAreSharedAndNumbered)
{
    const Scene scene = read(data_text("full.gun"), Format::gun);
    ASSERT_EQ(scene.optics.size(), 3U);
    EXPECT_EQ(scene.optics[0].name, "optics_1");
    EXPECT_EQ(scene.optics[2].name, "optics_3");
    EXPECT_EQ(scene.objects[0].optics, scene.objects[2].optics);
    EXPECT_EQ(scene.optics[2].absorption, (Rgb{1, .5, .5}));
}

TEST(ReadGun, DecorationsBecomeTexturesOfLinearLight)
{
    const Scene scene = read(data_text("full.gun"), Format::gun);
    ASSERT_EQ(scene.textures.size(), 4U);
    const Texture& first = scene.textures[0];
    EXPECT_EQ(first.name, "texture_1");
    EXPECT_EQ(std::get<Directional>(first.mapping).n, (Vec3{0, 0, 1}));
    EXPECT_TRUE(first.photograph.linear);
    EXPECT_FALSE(first.photograph.interpolate);
    EXPECT_EQ(first.wrap_x, .25);
    EXPECT_EQ(first.wrap_y, -.5);
    EXPECT_EQ(first.reflection, (Rgb{.5, .5, .5}));
    EXPECT_EQ(first.refraction, Rgb{});
    EXPECT_EQ(std::get<Positional>(scene.textures[1].mapping).n, (Vec3{0, 0, 2}));
    EXPECT_EQ(std::get<Relative>(scene.textures[2].mapping).origin, (Vec3{1, 2, 3}));
    EXPECT_EQ(std::get<Linear>(scene.textures[3].mapping).origin, (Vec3{1, 2, 3}));
    EXPECT_FALSE(scene.objects[1].texture.has_value());
}

TEST(ReadRayt, AllOfTheLanguageIsUnderstood)
{
    const Scene scene = read(data_text("full.rayt"), Format::rayt);
    EXPECT_EQ(scene.settings.media_rule, MediaRule::rank);
    ASSERT_EQ(scene.objects.size(), 9U);
    EXPECT_TRUE(std::holds_alternative<Complement>(scene.objects[0].solid->node));
    EXPECT_TRUE(std::holds_alternative<Complement>(scene.objects[2].solid->node)) << "x 1 is the member itself";
    EXPECT_EQ(scene.optics[scene.objects[6].optics].index, -1);
    const auto& sky = std::get<SkyPhotograph>(scene.sky).photograph;
    EXPECT_FALSE(sky.linear);
    EXPECT_FALSE(sky.interpolate);
}

TEST(ReadRayt, ParabolIsTheSideAwayFromTheFocus)
{
    const Scene scene = read(data_text("full.rayt"), Format::rayt);
    const auto& of = std::get<Intersection>(scene.objects[3].solid->node).of;
    EXPECT_TRUE(std::holds_alternative<Paraboloid>(std::get<Complement>(of[0]->node).of->node));
    EXPECT_EQ(std::get<Paraboloid>(of[1]->node), (Paraboloid{{1, 2, 3}, {0, 1, 0}}));
}

TEST(ReadRayt, CuboidsHaveReciprocalHalfSizesOfAnySignAndZeroIsUnbounded)
{
    const Scene scene = read(data_text("full.rayt"), Format::rayt);
    EXPECT_EQ(std::get<Cuboid>(scene.objects[6].solid->node), (Cuboid{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, .5, 0}}));
}

TEST(ReadRayt, AWindowThatIsComputedHoldsOnlyNumbersThatATextMaySay)
{
    const Scene scene = read("6.1e37 -4 .2  0 0 0  -2 -.3 0\n0\nrgb\n0\n", Format::rayt);
    const auto window = std::get<Window>(scene.observer);
    EXPECT_NEAR(window.row.z, -std::hypot(2, .3), 1e-12);
    EXPECT_EQ(window.row.x, 0); // 6.6e-39
    EXPECT_EQ(read(print_scene(scene)), scene);
}

TEST(ReadRayt, TheWindowIsSquareAndStandsAcrossTheView)
{
    const std::string rest = " 0 rgb 0";
    auto window = std::get<Window>(read("0 0 0  0 2 0  3 1 0" + rest, Format::rayt).observer);
    const double side = std::sqrt(10.0);
    expect_near(window.row, {0, 0, side});
    expect_near(window.column, {side, 0, 0});
    window = std::get<Window>(read("0 -4 1  0 0 1  0 0 3" + rest, Format::rayt).observer);
    expect_near(window.row, {-3, 0, 0});
    expect_near(window.column, {0, 0, 3});
}

TEST(ReadRayt, ASceneMayBeEmpty)
{
    const Scene scene = read("0 0 0 0 1 0 1 0 0\n0\nhsv\n0", Format::rayt);
    EXPECT_TRUE(scene.objects.empty());
    EXPECT_EQ(scene.sky, Sky(SkyHsv{}));
    EXPECT_EQ(read("0 0 0 0 1 0 1 0 0\n0\nrgb\n0\n", Format::rayt).sky, Sky(SkyRgb{}));
}

TEST(ReadOriginal, NumbersAreThoseOfCppStreams)
{
    const Scene scene = read("+1 .5 5.\t1e-3 -1E+2 0\r\n1 0 0 0\nrgb 0", Format::rayt);
    const auto window = std::get<Window>(scene.observer);
    EXPECT_EQ(window.eye, (Vec3{1, .5, 5}));
    EXPECT_EQ(window.view, (Vec3{.001, -100, 0}));
}

TEST(ReadOriginal, TheFilesEndingTellsTheFormat)
{
    EXPECT_EQ(format_of("a/b.gun"), Format::gun);
    EXPECT_EQ(format_of("b.rayt"), Format::rayt);
    EXPECT_EQ(format_of("b.clucida"), Format::clucida);
    EXPECT_EQ(format_of("gun"), Format::clucida);
    EXPECT_EQ(load_scene_text((data_folder() / "full.gun").string()).format, Format::gun);
    EXPECT_EQ(read_scene_file((data_folder() / "full.rayt").string()).objects.size(), 9U);
}

TEST(ReadGun, ANegativeIndexIsOpaqueAsInTheAuthorsOwnTexts)
{
    const Scene scene =
        read("0 -5 0  0 0 0  1 0 0  0 0 -1  1 0 0  sphere 0 0 0 1  0 0 0  1 1 1  -1  0 0 0  1 1 1  rgb 0", Format::gun);
    EXPECT_EQ(scene.optics[0].index, 0);
}

TEST(ReadRayt, AnEmittedColourIsDecodedFromItsByteAsSrgb)
{
    const Scene scene =
        read("0 -5 0  0 0 0  1 0 0  1  sphere 0 0 0 1 optics 0 0 0  0 0 0  -1  0.5 1 0  1 1 1  rgb 0", Format::rayt);
    EXPECT_NEAR(scene.optics[0].refraction.r, std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1e-12);
    EXPECT_EQ(scene.optics[0].refraction.g, 1);
    EXPECT_EQ(scene.optics[0].refraction.b, 0);
}

} // namespace
} // namespace clucida::scene::test
