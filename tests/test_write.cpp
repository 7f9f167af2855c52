/// What is printed reads back as an equal scene: for every language, every node and option, and thousands of scenes
/// made at random.
#include "scene/write.h"
#include "test_read_support.h"

#include <cmath>
#include <random>
#include <vector>

namespace clucida::scene::test {
namespace {

void expect_round_trip(const Scene& scene)
{
    const std::string text = print_scene(scene);
    try {
        const Scene again = read(text);
        EXPECT_TRUE(again == scene) << text;
        EXPECT_EQ(print_scene(again), text) << "the text is not canonical";
    } catch (const Error& error) {
        ADD_FAILURE() << error.what() << "\n" << text;
    }
}

SolidPtr sphere(double radius)
{
    return make_solid(Sphere{{0, 0, 0}, radius});
}

std::string printed(const SolidPtr& solid)
{
    Scene scene;
    scene.observer = Pinhole{{0, -6, 2}, {0, 0, 0}};
    scene.optics.push_back({});
    scene.objects.push_back({"", solid, 0, {}, {}});
    expect_round_trip(scene);
    const std::string text = print_scene(scene);
    const std::string before = "{ solid ";
    const std::size_t begin = text.rfind(before) + before.size();
    return text.substr(begin, text.rfind("; optics") - begin);
}

TEST(Write, EachLanguagesFullTextComesBackEqual)
{
    expect_round_trip(read(data_text("full.clucida")));
    expect_round_trip(read(data_text("full.gun"), Format::gun));
    expect_round_trip(read(data_text("full.rayt"), Format::rayt));
}

TEST(Write, ParenthesesStandWhereTheyAreNeededAndNowhereElse)
{
    const SolidPtr a = sphere(1);
    const SolidPtr b = sphere(2);
    const std::string s = "sphere([0, 0, 0], 1)";
    const std::string t = "sphere([0, 0, 0], 2)";
    const auto both = [&](const SolidPtr& x, const SolidPtr& y) { return make_solid(Intersection{{x, y}}); };
    const auto any = [&](const SolidPtr& x, const SolidPtr& y) { return make_solid(Union{{x, y}}); };
    const auto less = [&](const SolidPtr& x, const SolidPtr& y) { return make_solid(Difference{x, y}); };
    EXPECT_EQ(printed(any(both(a, b), less(a, b))), s + " & " + t + " | " + s + " - " + t);
    EXPECT_EQ(printed(both(both(a, b), a)), "(" + s + " & " + t + ") & " + s);
    EXPECT_EQ(printed(both(any(a, b), less(a, b))), "(" + s + " | " + t + ") & (" + s + " - " + t + ")");
    EXPECT_EQ(printed(any(any(a, b), a)), "(" + s + " | " + t + ") | " + s);
    EXPECT_EQ(printed(less(less(a, b), both(a, b))), s + " - " + t + " - " + s + " & " + t);
    EXPECT_EQ(printed(less(a, less(a, b))), s + " - (" + s + " - " + t + ")");
    EXPECT_EQ(printed(make_solid(Complement{both(a, b)})), "!(" + s + " & " + t + ")");
    EXPECT_EQ(printed(make_solid(Complement{make_solid(Complement{a})})), "!!" + s);
    EXPECT_EQ(printed(make_solid(Transformed{Move{{1, 2, 3}}, any(a, b)})), "move([1, 2, 3], " + s + " | " + t + ")");
}

TEST(Write, NamedSolidsKeepTheirNamesAndAreDefinedOnce)
{
    const Scene scene = read("clucida 1\nobserver { eye [0,-6,2]; look [0,0,0] }\n"
                             "solid ball = sphere([0,0,0], 1)\nsolid two = ball | ball\n"
                             "object { solid two & ball; optics { } }\nobject { solid two; optics { } }");
    const Scene again = read(print_scene(scene));
    EXPECT_EQ(again.objects[1].solid->name, "two");
    EXPECT_EQ(std::get<Intersection>(again.objects[0].solid->node).of[0], again.objects[1].solid);
    expect_round_trip(scene);
}

TEST(Write, SharedSolidsWithoutNamesDoNotMakeTheTextExplode)
{
    SolidPtr s = sphere(1);
    for (int i = 0; i < 16; ++i) s = make_solid(Union{{s, s}});
    EXPECT_EQ(printed(s), "solid_15 | solid_15");
}

TEST(Write, NamesThatAreNoneOrTakenAreReplaced)
{
    Scene scene;
    scene.observer = Pinhole{{0, -6, 2}, {0, 0, 0}};
    const auto named = [](const std::string& name, double radius) {
        return make_solid(Sphere{{0, 0, 0}, radius}, {}, name);
    };
    scene.optics = {Optics{}, Optics{}};
    scene.optics[0].name = "a b";
    scene.optics[1].name = "\n}";
    scene.objects.push_back({"x", named("sphere", 1), 0, {}, {}});
    scene.objects.push_back({"x", make_solid(Union{{named("a", 2), named("a", 3), named("1; }", 4)}}), 1, {}, {}});
    const Scene again = read(print_scene(scene));
    ASSERT_EQ(again.objects.size(), 2U);
    EXPECT_EQ(*again.objects[0].solid, *scene.objects[0].solid);
    EXPECT_EQ(*again.objects[1].solid, *scene.objects[1].solid);
}

TEST(Write, DefaultsAreLeftOut)
{
    Scene scene;
    scene.observer = Pinhole{{0, -6, 2}, {0, 0, 0}};
    scene.lights.push_back({});
    EXPECT_EQ(print_scene(scene),
              "clucida 1\nobserver { eye [0, -6, 2]; look [0, 0, 0] }\nlight { point [0, 0, 0] }\n");
}

TEST(Write, SkiesObserversAndSettingsOfAllKindsComeBackEqual)
{
    Scene scene;
    scene.observer = Window{{0, -6, 2}, {0, 0, 0}, {1, 0, .1}, {0, .2, -1}};
    Photograph photograph;
    photograph.path = "quad.ppm";
    for (const bool option : {false, true}) {
        photograph.linear = option;
        photograph.interpolate = !option;
        const std::vector<Sky> skies{SkyColor{},
                                     SkyColor{{1, 2, 3}},
                                     SkyColor{{.5, .5, .5}},
                                     SkyGradient{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     SkyGradient{{0, 1, 1}, {}, {}, {}},
                                     SkyRgb{},
                                     SkyHsv{},
                                     SkyPhotograph{photograph}};
        for (const Sky& sky : skies) {
            scene.sky = sky;
            expect_round_trip(scene);
        }
    }
    for (const LightLaw law : {LightLaw::paper, LightLaw::lambert, LightLaw::inverse_square}) {
        for (const MediaRule rule : {MediaRule::nearest, MediaRule::rank}) {
            for (const double cutoff : {0.0, 1.0 / 256, 0.1, 1.0}) {
                scene.settings = {law == LightLaw::paper ? 19U : 1'000'000U, cutoff, law, rule};
                expect_round_trip(scene);
            }
        }
    }
}

/// Scenes made at random, such as readers make: names are good and given once, nameless optics have one user.
class RandomScenes {
public:
    explicit RandomScenes(unsigned seed) : random_(seed) {}

    Scene scene()
    {
        Scene s;
        observer(s);
        sky(s);
        if (chance(2)) {
            s.settings = {1 + below(100), std::abs(std::fmod(number(), 1.0)), static_cast<LightLaw>(below(3)),
                          static_cast<MediaRule>(below(2))};
        }
        for (unsigned i = below(4); i > 0; --i) s.lights.push_back({vector(), light(), {}});
        pool_.clear();
        const unsigned objects = below(6);
        for (unsigned i = 0; i < objects; ++i) object(s, i);
        return s;
    }

private:
    unsigned below(unsigned n) { return std::uniform_int_distribution<unsigned>(0, n - 1)(random_); }
    bool chance(unsigned n) { return below(n) == 0; }
    double number()
    {
        if (chance(3)) return static_cast<double>(below(21)) - 10;
        const double mantissa = std::uniform_real_distribution<double>(-1, 1)(random_);
        return chance(4) ? mantissa * std::pow(10, static_cast<int>(below(60)) - 30) : mantissa;
    }
    double positive() { return std::abs(number()) + 1e-3; }
    double unit() { return chance(3) ? below(2) : std::uniform_real_distribution<double>(0, 1)(random_); }
    Vec3 vector() { return {number(), number(), number()}; }
    Vec3 direction() { return {1 + unit(), number(), number()}; }
    Rgb filter()
    {
        if (chance(2)) return {};
        const double grey = unit();
        return chance(2) ? Rgb{grey, grey, grey} : Rgb{unit(), unit(), unit()};
    }
    Rgb light() { return chance(2) ? Rgb{1, 1, 1} : Rgb{positive(), 0, positive()}; }
    Photograph photograph()
    {
        Photograph p;
        p.path = chance(2) ? "quad.ppm" : "grey.pgm";
        p.linear = chance(2);
        p.interpolate = chance(2);
        return p;
    }
    void observer(Scene& s)
    {
        if (chance(2)) {
            s.observer = Window{{0, 0, number()}, {1, 0, 0}, direction(), direction()};
        } else {
            s.observer = Pinhole{{0, 0, 2}, {1, number(), 2}, {0, 0, positive()}, 1 + 178 * unit()};
        }
    }
    void sky(Scene& s)
    {
        switch (below(5)) {
        case 0: s.sky = SkyColor{light()}; break;
        case 1: s.sky = SkyGradient{direction(), light(), light(), light()}; break;
        case 2: s.sky = SkyRgb{}; break;
        case 3: s.sky = SkyHsv{}; break;
        default: s.sky = SkyPhotograph{photograph()};
        }
    }
    decltype(Solid::node) primitive()
    {
        // The x directions stand off the axes by their z.
        const Vec3 x{1, 0, chance(2) ? 0 : 1.0};
        switch (below(10)) {
        case 0: return Plane{vector(), direction()};
        case 1: return Sphere{vector(), positive()};
        case 2: return Cylinder{vector(), direction()};
        case 3: return Cone{vector(), direction()};
        case 4: return Paraboloid{vector(), direction()};
        case 5: return Hyperboloid{vector(), direction(), positive()};
        case 6: return Saddle{vector(), {0, 0, positive()}, x};
        case 7: {
            const double major = positive();
            return Torus{vector(), direction(), major, major * .25};
        }
        case 8: {
            FreeQuadric quadric;
            do
                for (double& x : quadric.q) x = number();
            while (!has_boundary(quadric));
            return quadric;
        }
        default: return Cuboid{vector(), chance(2) ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, x, {positive(), 1, 0}};
        }
    }
    SolidPtr solid(unsigned depth)
    {
        if (!pool_.empty() && chance(4)) return pool_[below(static_cast<unsigned>(pool_.size()))];
        decltype(Solid::node) node = primitive();
        if (depth > 0) {
            switch (below(6)) {
            case 0: node = Complement{solid(depth - 1)}; break;
            case 1: node = Difference{solid(depth - 1), solid(depth - 1)}; break;
            case 2: node = Transformed{transform(), solid(depth - 1)}; break;
            case 3: node = Intersection{solids(depth - 1)}; break;
            case 4: node = Union{solids(depth - 1)}; break;
            default: break;
            }
        }
        const bool named = chance(4);
        SolidPtr made = make_solid(std::move(node), {}, named ? "s" + std::to_string(pool_.size()) : "");
        if (named) pool_.push_back(made);
        return made;
    }
    std::vector<SolidPtr> solids(unsigned depth)
    {
        std::vector<SolidPtr> all;
        for (unsigned i = 2 + below(3); i > 0; --i) all.push_back(solid(depth));
        return all;
    }
    decltype(Transformed::by) transform()
    {
        switch (below(3)) {
        case 0: return Move{vector()};
        case 1: return Rotate{direction(), number()};
        default: return chance(2) ? Scale{{2, 2, 2}} : Scale{{positive(), -positive(), positive()}};
        }
    }
    void object(Scene& s, unsigned number_of)
    {
        Object o;
        if (chance(2)) o.name = "o" + std::to_string(number_of);
        o.solid = solid(4);
        if (!s.optics.empty() && !s.optics.back().name.empty() && chance(2)) {
            o.optics = s.optics.size() - 1;
        } else {
            Optics optics{"", filter(), filter(), chance(2) ? 0 : number(), filter(), {1, 1, 1}, chance(3), {}};
            if (chance(2)) optics.passthrough = filter();
            if (chance(2)) optics.name = "p" + std::to_string(s.optics.size());
            o.optics = s.optics.size();
            s.optics.push_back(optics);
        }
        if (chance(2)) {
            o.texture = s.textures.size();
            Texture t;
            if (chance(2)) t.name = "t" + std::to_string(s.textures.size());
            t.photograph = photograph();
            switch (below(5)) {
            case 0: t.mapping = Directional{direction()}; break;
            case 1: t.mapping = Positional{direction()}; break;
            case 2: t.mapping = Relative{direction(), vector()}; break;
            case 3: t.mapping = Linear{direction(), vector()}; break;
            default: t.mapping = Planar{vector(), {positive(), 0, 0}, {0, 0, positive()}};
            }
            if (chance(2)) t.wrap_x = number();
            if (chance(2)) t.wrap_y = number();
            t.reflection = filter();
            t.absorption = filter();
            t.refraction = filter();
            s.textures.push_back(t);
        }
        s.objects.push_back(std::move(o));
    }

    std::mt19937 random_;
    std::vector<SolidPtr> pool_; ///< named solids, which later ones may use
};

TEST(Write, ScenesMadeAtRandomComeBackEqual)
{
    RandomScenes random(20160229);
    std::size_t objects = 0;
    for (int i = 0; i < 5000 && !HasFailure(); ++i) {
        const Scene scene = random.scene();
        objects += scene.objects.size();
        SCOPED_TRACE(i);
        expect_round_trip(scene);
    }
    EXPECT_GT(objects, 10'000U);
}

TEST(Write, AnyChangeOfAValueChangesTheTextAndTheComparison)
{
    RandomScenes random(7);
    for (int i = 0; i < 300; ++i) {
        const Scene a = random.scene();
        const Scene b = random.scene();
        EXPECT_EQ(a == b, print_scene(a) == print_scene(b));
    }
}

} // namespace
} // namespace clucida::scene::test
