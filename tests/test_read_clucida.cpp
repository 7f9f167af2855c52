#include "test_read_support.h"

#include <cmath>

namespace clucida::scene::test {
namespace {

const std::string head = "clucida 1\nobserver { eye [0,-6,2]; look [0,0,0] }\n";

SolidPtr solid(const std::string& expression, const std::string& definitions = "")
{
    const Scene scene = read(head + definitions + "\nobject { solid " + expression + "; optics { } }");
    return scene.objects.at(0).solid;
}

double number(const std::string& expression)
{
    return std::get<Sphere>(solid("sphere([0,0,0], " + expression + ")")->node).radius;
}

TEST(ReadClucida, AnEmptySceneNeedsAVersionAndAnObserver)
{
    const Scene scene = read(head);
    EXPECT_TRUE(scene.objects.empty());
    EXPECT_EQ(scene.sky, Sky(SkyColor{}));
    EXPECT_EQ(scene.settings, Settings{});
    EXPECT_EQ(scene.observer, Observer(Pinhole{{0, -6, 2}, {0, 0, 0}, {0, 0, 1}, 45}));
}

TEST(ReadClucida, AllOfTheLanguageIsUnderstood)
{
    const Scene scene = read(data_text("full.clucida"));
    EXPECT_EQ(scene.settings, (Settings{7, 1.0 / 128, LightLaw::lambert, MediaRule::rank}));
    EXPECT_EQ(std::get<Pinhole>(scene.observer).fov, 40);
    EXPECT_EQ(std::get<SkyGradient>(scene.sky), (SkyGradient{{0, 1, 1}, {.2, .3, .5}, {.5, .5, .5}, {0, 0, 1}}));
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.lights[0].color, (Rgb{1, 2, 3}));
    EXPECT_EQ(scene.lights[1].point, (Vec3{1, 0.5 * std::sqrt(2.0), 1}));
    ASSERT_EQ(scene.optics.size(), 3U);
    EXPECT_TRUE(scene.optics[0].fresnel);
    EXPECT_EQ(scene.optics[0].passthrough, (Rgb{.9, .99, .9}));
    EXPECT_EQ(scene.optics[1].index, -1);
    EXPECT_EQ(scene.optics[2].name, "");
    ASSERT_EQ(scene.textures.size(), 5U);
    EXPECT_TRUE(scene.textures[0].photograph.linear);
    EXPECT_FALSE(scene.textures[0].photograph.interpolate);
    EXPECT_EQ(scene.textures[0].wrap_y, -.5);
    EXPECT_EQ(std::get<Linear>(scene.textures[3].mapping).origin, (Vec3{1, 2, 3}));
    EXPECT_EQ(std::get<Planar>(scene.textures[4].mapping).v, (Vec3{0, 3, 0}));
    ASSERT_EQ(scene.objects.size(), 6U);
    EXPECT_EQ(scene.objects[0].name, "first");
    EXPECT_EQ(scene.objects[0].solid->name, "cup");
    EXPECT_EQ(scene.objects[0].texture, 0U);
    EXPECT_EQ(scene.objects[2].texture, 4U);
    EXPECT_EQ(scene.objects[2].optics, 2U);
}

TEST(ReadClucida, OperatorsBindAsTheManualSays)
{
    const std::string names = "solid a = sphere([0,0,0],1)\nsolid b = sphere([0,0,0],2)\nsolid c = sphere([0,0,0],3)\n";
    EXPECT_EQ(*solid("a | b - c", names), *solid("a | (b - c)", names));
    EXPECT_EQ(*solid("a - b & c", names), *solid("a - (b & c)", names));
    EXPECT_EQ(*solid("a - b - c", names), *solid("(a - b) - c", names));
    EXPECT_EQ(*solid("!a & b", names), *solid("(!a) & b", names));
    EXPECT_EQ(std::get<Intersection>(solid("a & b & c", names)->node).of.size(), 3U);
    EXPECT_EQ(std::get<Union>(solid("(a | b) | c", names)->node).of.size(), 2U);
    EXPECT_FALSE(*solid("(a | b) | c", names) == *solid("a | b | c", names));
}

TEST(ReadClucida, ANamedSolidIsOneNodeHoweverOftenItIsUsed)
{
    const SolidPtr s = solid("a | a", "solid a = sphere([0,0,0],1)");
    const auto& of = std::get<Union>(s->node).of;
    EXPECT_EQ(of[0], of[1]);
    EXPECT_EQ(of[0]->name, "a");
}

TEST(ReadClucida, AQuadricHasItsFactorsInPovRaysOrder)
{
    const auto node = solid("quadric([1, 2, 3], [4, 5, 6], [7, 8, 9], 10)")->node;
    EXPECT_EQ(std::get<FreeQuadric>(node), (FreeQuadric{{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}));
    EXPECT_EQ(std::get<Torus>(solid("torus([1,2,3], [0,0,4], 5, .5)")->node), (Torus{{1, 2, 3}, {0, 0, 4}, 5, .5}));
}

TEST(ReadClucida, ShortFormsMeanTheirLongOnes)
{
    const Cylinder cylinder = std::get<Cylinder>(solid("cylinder([1,2,3], [0,0,4], .5)")->node);
    EXPECT_EQ(cylinder.axis, (Vec3{0, 0, .5}));
    const Cuboid cuboid = std::get<Cuboid>(solid("cuboid([1,2,3], [4,5,6])")->node);
    EXPECT_EQ(cuboid, (Cuboid{{1, 2, 3}, {0, 0, 1}, {1, 0, 0}, {4, 5, 6}}));
    EXPECT_EQ(*solid("rotate([0,0,1], 90, [1,2,3], sphere([0,0,0],1))"),
              *solid("move([1,2,3], rotate([0,0,1], 90, move([-1,-2,-3], sphere([0,0,0],1))))"));
    EXPECT_EQ(*solid("scale(2, sphere([0,0,0],1))"), *solid("scale([2,2,2], sphere([0,0,0],1))"));
}

TEST(ReadClucida, ArithmeticStandsWhereverANumberDoes)
{
    EXPECT_EQ(number("1/4"), .25);
    EXPECT_EQ(number("+1.5e-3"), .0015);
    EXPECT_EQ(number("(1 +\n 2) * 3"), 9);
    EXPECT_EQ(number("3 > 2 ? 5 : 6"), 5);
    EXPECT_DOUBLE_EQ(number("sin(pi/2) + cos(0)"), 2);
    EXPECT_DOUBLE_EQ(number("tau / 2"), std::acos(-1.0));
    EXPECT_DOUBLE_EQ(number("ln(e)"), 1);
    EXPECT_EQ(number("max(1, 2, 3)"), 3);
    EXPECT_EQ(number("floor(1.7) + ceil(0.2)"), 2);
    for (const char* name : {"sin",   "cos",   "tan",   "asin",  "acos", "atan", "sinh", "cosh", "tanh",
                             "asinh", "acosh", "atanh", "sqrt",  "exp",  "ln",   "log",  "log2", "log10",
                             "abs",   "sign",  "rint",  "floor", "ceil", "min",  "max",  "sum",  "avg"}) {
        EXPECT_EQ(number(std::string("1 + 0 * ") + name + (std::string(name) == "atanh" ? "(0)" : "(1)")), 1) << name;
    }
    EXPECT_EQ(number("2 # two\n + 3"), 5);
}

TEST(ReadClucida, LinesEndStatementsOutsideBracketsOnly)
{
    EXPECT_EQ(*solid("sphere(\n[0,\n0,0] # center\n,\n1)"), *solid("sphere([0,0,0],1)"));
    EXPECT_EQ(*solid("!sphere([0,0,0],1) |\n\n  # more\n sphere([0,0,0],2)"),
              *solid("!sphere([0,0,0],1) | sphere([0,0,0],2)"));
}

TEST(ReadClucida, CarriageReturnsAByteOrderMarkAndAMissingLastNewlineDoNoHarm)
{
    const std::string text = data_text("full.clucida");
    const Scene scene = read(text);
    std::string crlf;
    for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(read(crlf), scene);
    EXPECT_EQ(read("\xEF\xBB\xBF" + text), scene);
    EXPECT_EQ(read(text.substr(0, text.size() - 1)), scene);
}

TEST(ReadClucida, SkiesAreOfFiveKinds)
{
    EXPECT_EQ(read(head + "sky color .5").sky, Sky(SkyColor{{.5, .5, .5}}));
    EXPECT_EQ(read(head + "sky rgb").sky, Sky(SkyRgb{}));
    EXPECT_EQ(read(head + "sky hsv").sky, Sky(SkyHsv{}));
    const auto sky =
        std::get<SkyPhotograph>(read(head + "sky photograph \"quad.ppm\" { encoding linear; filter nearest }").sky);
    EXPECT_TRUE(sky.photograph.linear);
    EXPECT_FALSE(sky.photograph.interpolate);
    EXPECT_EQ(std::filesystem::path(sky.photograph.file).filename(), "quad.ppm");
    EXPECT_TRUE(std::get<SkyPhotograph>(read(head + "sky photograph \"quad.ppm\"").sky).photograph.interpolate);
}

TEST(ReadClucida, TheOriginalsWindowCanBeTheObserver)
{
    const Scene scene = read("clucida 1\nobserver window { eye [1,2,3]; view [4,5,6]; column [1,0,0]; row [0,1,0] }");
    EXPECT_EQ(scene.observer, Observer(Window{{1, 2, 3}, {4, 5, 6}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(ReadClucida, ThingsKnowTheirPlaces)
{
    const Scene scene = read(head + "light { point [1,2,3] }\nobject { solid sphere([0,0,0],1); optics { } }");
    EXPECT_EQ(scene.lights[0].at.line, 3U);
    EXPECT_EQ(scene.objects[0].at.line, 4U);
    EXPECT_EQ(scene.objects[0].solid->at.column, 16U);
}

} // namespace
} // namespace clucida::scene::test
