// Photographs on surfaces and on the sky: which texel a direction or a point shows.
#include "native_scene.h"

#include "scene/pack.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <unistd.h>

namespace clucida::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A photograph of 4x4: red tells the column, green the row, blue is 200. And the folder that it lies in.
class Photo {
public:
    Photo() : folder(std::filesystem::temp_directory_path() / ("clucida_texture_" + std::to_string(::getpid())))
    {
        std::filesystem::create_directories(folder);
        std::ofstream file(folder / "four.ppm", std::ios::binary);
        file << "P6 4 4 255\n";
        for (int row = 0; row < 4; row++)
            for (int column = 0; column < 4; column++)
                file << static_cast<char>(value(column)) << static_cast<char>(value(row)) << static_cast<char>(200);
    }
    ~Photo() { std::filesystem::remove_all(folder); }
    Photo(const Photo&) = delete;
    Photo& operator=(const Photo&) = delete;
    static int value(int i) { return 30 + 60 * i; }
    scene::Photograph photograph(bool interpolate = false, bool linear = true) const
    {
        return {"four.ppm", (folder / "four.ppm").string(), linear, interpolate, {}};
    }

private:
    std::filesystem::path folder;
};

template <typename P>
class KernelsTexture : public ::testing::Test {
protected:
    Photo photo;
};
TYPED_TEST_SUITE(KernelsTexture, Machines, MachineNames);

/// A lamp-white room's wall: what is seen is the texture's reflection of a white sky.
template <typename P>
Rgb seen(const Native& scene, Vec3 o, Vec3 d)
{
    Stats stats{};
    const Rgb color = trace<P>(scene, o, d, stats);
    expect_sound(stats);
    return color;
}

Scene textured(SolidPtr solid, scene::Texture texture)
{
    Scene scene = empty_scene();
    scene.sky = scene::SkyColor{{1, 1, 1}};
    texture.reflection = {1, 1, 1};
    scene.textures.push_back(std::move(texture));
    add(scene, std::move(solid), Optics{});
    scene.objects[0].texture = 0;
    return scene;
}

/// The texel at u, v as the formats have it: the fractions, and the column and row they fall into.
Rgb texel(double u, double v)
{
    const auto at = [](double x) { return Photo::value(static_cast<int>((x - std::floor(x)) * 4)) / 255.; };
    return {at(u), at(v), 200 / 255.};
}

bool near_edge(double u, double v)
{
    const auto near = [](double x) { return std::fabs(4 * x - std::round(4 * x)) < 1e-4; };
    return near(u) || near(v);
}

struct Frame {
    Vec3 x, y, z;
    double size;
};
Frame frame_of(Vec3 n)
{
    const double size = scene::length(n), theta = std::acos(n.z / size), phi = std::atan2(n.y, n.x);
    return {{std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta)},
            {-std::sin(phi), std::cos(phi), 0},
            n * (1 / size),
            size};
}
std::pair<double, double> angles(const Frame& f, Vec3 d)
{
    double phi = std::atan2(scene::dot(f.y, d), scene::dot(f.x, d));
    if (phi < -pi / 2) phi += 2 * pi;
    return {(phi + pi / 2) / (2 * pi), std::acos(scene::dot(f.z, d) / scene::length(d)) / pi};
}

void expect_color(const Rgb& got, const Rgb& expected, const std::string& where)
{
    EXPECT_NEAR(got.r, expected.r, 1e-6) << where;
    EXPECT_NEAR(got.g, expected.g, 1e-6) << where;
    EXPECT_NEAR(got.b, expected.b, 1e-6) << where;
}

/// Rays at a ball at (0, 3, 0), textured; uv gives what is expected of a point and its normal.
template <typename P>
void check_ball(const Photo& photo, decltype(scene::Texture::mapping) mapping,
                const std::function<std::pair<double, double>(Vec3, Vec3)>& uv)
{
    scene::Texture texture;
    texture.photograph = photo.photograph();
    texture.mapping = mapping;
    const Vec3 center{.5, 3, -.25};
    const Native scene(textured(sphere(center, 1), texture));
    Random random(1);
    int checked = 0;
    for (int i = 0; i < 3000 / P::share; i++) {
        const Vec3 n = random_direction(random), p = center + n;
        const auto [u, v] = uv(p, n);
        if (near_edge(u, v)) continue;
        expect_color(seen<P>(scene, p + n * 2, -n), texel(u, v), "at " + std::to_string(u) + ", " + std::to_string(v));
        checked++;
    }
    EXPECT_GT(checked, 2500 / P::share);
}

TYPED_TEST(KernelsTexture, DirectionalTakesTheNormalsAngles)
{
    for (const Vec3 n : {Vec3{0, 0, 1}, Vec3{.3, -.4, .5}, Vec3{1, 2, -2}}) {
        const Frame f = frame_of(n);
        check_ball<TypeParam>(this->photo, scene::Directional{n}, [&](Vec3, Vec3 normal) {
            const auto [u, v] = angles(f, normal);
            return std::pair{u / f.size, v / f.size};
        });
    }
}

TYPED_TEST(KernelsTexture, RelativeTakesTheAnglesSeenFromAPoint)
{
    const Vec3 n{.3, -.4, .5}, origin{.6, 3.2, 0};
    const Frame f = frame_of(n);
    check_ball<TypeParam>(this->photo, scene::Relative{n, origin}, [&](Vec3 p, Vec3) {
        const auto [u, v] = angles(f, p - origin);
        return std::pair{u / f.size, v / f.size};
    });
}

TYPED_TEST(KernelsTexture, PositionalProjectsAlongItsVector)
{
    const Vec3 n{.3, -.4, .5};
    const Frame f = frame_of(n);
    check_ball<TypeParam>(this->photo, scene::Positional{n}, [&](Vec3 p, Vec3) {
        return std::pair{scene::dot(f.x, p) / f.size, scene::dot(f.y, p) / f.size};
    });
}

TYPED_TEST(KernelsTexture, LinearGoesAroundAndAlongItsAxis)
{
    const Vec3 n{.3, -.4, .5}, origin{.6, 3.2, 0};
    const Frame f = frame_of(n);
    check_ball<TypeParam>(this->photo, scene::Linear{n, origin}, [&](Vec3 p, Vec3) {
        const Vec3 d = p - origin;
        return std::pair{(std::atan2(scene::dot(f.y, d), scene::dot(f.x, d)) + pi) / (2 * pi),
                         scene::dot(f.z, d) / f.size};
    });
}

TYPED_TEST(KernelsTexture, PlanarSpansItsTwoVectors)
{
    const Vec3 origin{.25, 2, .5}, u{.75, 0, .25}, v{-.25, 0, .75};
    check_ball<TypeParam>(this->photo, scene::Planar{origin, u, v}, [&](Vec3 p, Vec3) {
        return std::pair{scene::dot(u, p - origin) / scene::dot(u, u), scene::dot(v, p - origin) / scene::dot(v, v)};
    });
}

/// A wall at y = 1 of which (x, z) in 0..1 shows the photograph once, z = 0 at the top.
Native wall(const Photo& photo, bool interpolate, double wrap_x = 0, double wrap_y = 0)
{
    scene::Texture texture;
    texture.photograph = photo.photograph(interpolate);
    texture.mapping = scene::Planar{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    texture.wrap_x = wrap_x;
    texture.wrap_y = wrap_y;
    return Native(textured(plane({0, 1, 0}, {0, -1, 0}), texture));
}

TYPED_TEST(KernelsTexture, BilinearMeetsTexelsInTheirMiddlesAndGoesAroundTheEdges)
{
    using P = TypeParam;
    const Native scene = wall(this->photo, true);
    const auto at = [&](double u, double v) { return seen<P>(scene, {u, 0, v}, {0, 1, 0}); };
    const auto level = [](double i) { return (30 + 60 * i) / 255; };
    expect_color(at(.125, .125), {level(0), level(0), 200 / 255.}, "a middle");
    expect_color(at(.375, .875), {level(1), level(3), 200 / 255.}, "a middle");
    expect_color(at(.25, .125), {level(.5), level(0), 200 / 255.}, "between columns");
    expect_color(at(.125, .3125), {level(0), level(.75), 200 / 255.}, "between rows");
    expect_color(at(0, .125), {level(1.5), level(0), 200 / 255.}, "between the last column and the first");
    expect_color(at(.125, 0), {level(0), level(1.5), 200 / 255.}, "between the last row and the first");
    expect_color(at(1.125, -.875), {level(0), level(0), 200 / 255.}, "repeated");
}

TYPED_TEST(KernelsTexture, WrapShiftsThePhotographOnce)
{
    using P = TypeParam;
    const Native scene = wall(this->photo, false, .25, .5);
    const auto at = [&](double u, double v) { return seen<P>(scene, {u, 0, v}, {0, 1, 0}); };
    expect_color(at(.1, .1), texel(.35, .6), "shifted");
    expect_color(at(.9, .6), texel(.15, .1), "around");
    const Native below = wall(this->photo, false, -.25, 0);
    expect_color(seen<P>(below, {.1, 0, .1}, {0, 1, 0}), {0, 0, 0}, "outside");
    expect_color(seen<P>(below, {.3, 0, .1}, {0, 1, 0}), texel(.05, .1), "inside");
}

TYPED_TEST(KernelsTexture, APhotographAddsToTheObjectsOwnFiltersUpToOne)
{
    using P = TypeParam;
    scene::Texture texture;
    texture.photograph = this->photo.photograph();
    texture.mapping = scene::Planar{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    Scene scene = textured(plane({0, 1, 0}, {0, -1, 0}), texture);
    scene.optics[0].reflection = {1, 0, 1};
    scene.textures[0].reflection = {1, 1, 0};
    expect_color(seen<P>(Native(scene), {.9, 0, .4}, {0, 1, 0}), {1, Photo::value(1) / 255., 1}, "reflection");
    scene.optics[0] = Optics{};
    scene.textures[0].reflection = {};
    scene.textures[0].absorption = {1, 1, 1};
    scene.lights.push_back({{.9, -9, .4}, {1, 1, 1}, {}});
    scene.settings.light_law = scene::LightLaw::lambert;
    expect_color(seen<P>(Native(scene), {.9, 0, .4}, {0, 1, 0}), texel(.9, .4), "absorption");
    scene.optics[0] = clear(1);
    scene.optics[0].refraction = {};
    scene.textures[0].absorption = {};
    scene.textures[0].refraction = {1, 1, 1};
    expect_color(seen<P>(Native(scene), {.9, 0, .4}, {0, 1, 0}), texel(.9, .4), "refraction");
}

TYPED_TEST(KernelsTexture, BytesAreDecodedFromSrgbUnlessLinear)
{
    using P = TypeParam;
    scene::Texture texture;
    texture.photograph = this->photo.photograph(false, false);
    texture.mapping = scene::Planar{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    const Rgb c = seen<P>(Native(textured(plane({0, 1, 0}, {0, -1, 0}), texture)), {.1, 0, .9}, {0, 1, 0});
    const auto decode = [](double byte) { return std::pow((byte / 255 + .055) / 1.055, 2.4); };
    expect_color(c, {decode(30), decode(210), decode(200)}, "decoded");
}

Scene sky_of(scene::Sky sky)
{
    Scene scene = empty_scene();
    scene.sky = std::move(sky);
    return scene;
}

TYPED_TEST(KernelsTexture, ThePhotographedSkyIsSeenFromInsideAndBeginsWithItsLastColumn)
{
    using P = TypeParam;
    const Native scene(sky_of(scene::SkyPhotograph{this->photo.photograph()}));
    const Frame f = frame_of({0, 0, 1});
    Random random(2);
    for (int i = 0; i < 3000 / P::share; i++) {
        const Vec3 d = random_direction(random);
        const auto [u, v] = angles(f, d);
        if (!near_edge(u, v)) expect_color(seen<P>(scene, {0, 0, 0}, d), texel(1 - u, v), "sky");
    }
    // u = 0 is the direction -y exactly: the last column, not one beyond.
    EXPECT_NEAR(seen<P>(scene, {0, 0, 0}, {0, -1, 0}).r, Photo::value(3) / 255., 1e-6);
    EXPECT_NEAR(seen<P>(scene, {0, 0, 0}, {0, 0, 1}).g, Photo::value(0) / 255., 1e-6);
    EXPECT_NEAR(seen<P>(scene, {0, 0, 0}, {0, 0, -1}).g, Photo::value(3) / 255., 1e-6);
}

TYPED_TEST(KernelsTexture, SkiesFollowTheirFormulas)
{
    using P = TypeParam;
    const Native rgb(sky_of(scene::SkyRgb{})), hsv(sky_of(scene::SkyHsv{})),
        gradient(sky_of(scene::SkyGradient{{0, 3, 4}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    const Frame f = frame_of({0, 0, 1});
    Random random(3);
    for (int i = 0; i < 3000 / P::share; i++) {
        const Vec3 d = random_direction(random);
        expect_color(seen<P>(rgb, {0, 0, 0}, d), {(d.x + 1) / 2, (d.y + 1) / 2, (1 - d.z) / 2}, "rgb");
        const double t = scene::dot(d, {0, .6, .8});
        expect_color(seen<P>(gradient, {0, 0, 0}, d), {std::max(0., -t), 1 - std::fabs(t), std::max(0., t)},
                     "gradient");
        const auto [u, v] = angles(f, d);
        const double saturation = std::min(1., 2 * v), value = std::min(1., 2 * (1 - v)), h = 6 * u;
        const double x = 1 - std::fabs(std::fmod(h, 2) - 1); // the hexcone model (Smith 1978)
        const double pure[6][3]{{1, x, 0}, {x, 1, 0}, {0, 1, x}, {0, x, 1}, {x, 0, 1}, {1, 0, x}};
        const auto& c = pure[std::min(5, static_cast<int>(h))];
        const auto mix = [&](double channel) { return value * (1 - saturation + saturation * channel); };
        const Rgb got = seen<P>(hsv, {0, 0, 0}, d);
        EXPECT_NEAR(got.r, mix(c[0]), 4e-6); // six hues a turn magnify the angle's rounding
        EXPECT_NEAR(got.g, mix(c[1]), 4e-6);
        EXPECT_NEAR(got.b, mix(c[2]), 4e-6);
    }
}

} // namespace
} // namespace clucida::test
