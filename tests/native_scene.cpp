#include "native_scene.h"

#include "scene/read.h"

namespace clucida::test {

void expect_sound(const Stats& stats)
{
    EXPECT_EQ(stats[STAT_PARITY], 0U) << "parity faults";
    EXPECT_EQ(stats[STAT_NAN], 0U) << "samples that are not a number";
    EXPECT_EQ(stats[STAT_INTERIOR_OVERFLOW], 0U) << "interior overflows";
    EXPECT_EQ(stats[STAT_STACK_OVERFLOW], 0U) << "stack overflows";
    EXPECT_EQ(stats[STAT_STUCK], 0U) << "rays given up";
}

Scene empty_scene()
{
    Scene scene;
    scene.observer = scene::Pinhole{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 45};
    scene.sky = scene::SkyColor{{0, 0, 0}};
    return scene;
}

Scene parse(const std::string& statements, const std::string& folder)
{
    std::string text = "clucida 1\n";
    if (statements.find("observer") == std::string::npos) text += "observer { eye [0,0,0]; look [0,1,0] }\n";
    return scene::read_scene(text + statements, "test", scene::Format::clucida, folder);
}

Optics clear(double index)
{
    Optics optics;
    optics.index = index;
    optics.refraction = {1, 1, 1};
    return optics;
}

Optics mirror()
{
    Optics optics;
    optics.reflection = {1, 1, 1};
    return optics;
}

Optics emitter(Rgb color)
{
    Optics optics;
    optics.index = -1;
    optics.refraction = color;
    return optics;
}

void add(Scene& scene, SolidPtr solid, const Optics& optics)
{
    scene.optics.push_back(optics);
    scene::Object object;
    object.solid = std::move(solid);
    object.optics = scene.optics.size() - 1;
    scene.objects.push_back(std::move(object));
}

Scene scene_of(const std::vector<SolidPtr>& solids)
{
    Scene scene = empty_scene();
    for (const SolidPtr& s : solids) add(scene, s, clear());
    return scene;
}

Vec3 random_in_box(Random& random, double half)
{
    const double x = uniform(random, -half, half), y = uniform(random, -half, half);
    return {x, y, uniform(random, -half, half)};
}

Vec3 random_direction(Random& random)
{
    while (true) {
        const Vec3 v = random_in_box(random, 1);
        const double size = scene::dot(v, v);
        if (size <= 1 && size > 0.01) return scene::unit(v);
    }
}

bool same_bits(const Image& a, const Image& b)
{
    return a.rgba.size() == b.rgba.size() && std::memcmp(a.rgba.data(), b.rgba.data(), 4 * a.rgba.size()) == 0;
}

double rmse(const Image& a, const Image& b)
{
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i++) {
        const double e = static_cast<double>(a.rgba[i]) - b.rgba[i];
        sum += e * e;
    }
    return std::sqrt(sum / (0.75 * static_cast<double>(a.rgba.size())));
}

} // namespace clucida::test
