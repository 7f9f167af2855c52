/// What the tests of the kernels share: scenes as values or text, random numbers, rays and pictures on any machine.
#pragma once

#include "machines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace clucida::test {

using scene::Optics;
using scene::Scene;
using scene::SolidPtr;
using scene::View;

struct MachineNames {
    template <typename P>
    static std::string GetName(int)
    {
        return P::name;
    }
};
#ifdef CLUCIDA_SANITIZED // which see nothing of a device's code; of the core in float and double one does
using Machines = ::testing::Types<Float, DoubleInPackets>;
#else
using Machines = ::testing::Types<Float, Double, FloatInPackets, DoubleInPackets, FloatOnDevice, DoubleOnDevice>;
#endif

/// Nothing that a sound trace never does: parity faults, NaNs, overflows, rays given up.
void expect_sound(const Stats& stats);

// Scenes.
/// An observer at the origin who looks along y, with z up; a black sky, no objects.
Scene empty_scene();
/// Reads statements of clucida's own language; "clucida 1" stands before them, and an observer if they have none.
Scene parse(const std::string& statements, const std::string& folder = ".");
Optics clear(double index = 1); ///< refraction 1, reflection 0
Optics mirror();                ///< reflection 1
Optics emitter(Rgb color);
void add(Scene& scene, SolidPtr solid, const Optics& optics);
/// One object for each solid, all clear with index 1.
Scene scene_of(const std::vector<SolidPtr>& solids);
inline SolidPtr solid(decltype(scene::Solid::node) node)
{
    return scene::make_solid(std::move(node));
}
inline SolidPtr complement(SolidPtr of)
{
    return solid(scene::Complement{std::move(of)});
}
inline SolidPtr sphere(Vec3 center, double radius)
{
    return solid(scene::Sphere{center, radius});
}
inline SolidPtr plane(Vec3 point, Vec3 normal)
{
    return solid(scene::Plane{point, normal});
}
inline SolidPtr cuboid(Vec3 center, Vec3 size)
{
    return solid(scene::Cuboid{center, {0, 0, 1}, {1, 0, 0}, size});
}

/// The worst of what a test measures, told with its result (docs/hard-cases.md). value counts in units of u unless its
/// name says otherwise.
struct Measured {
    const char* name;
    double value = 0;
    void see(double v) { value = std::max(value, std::fabs(v)); }
    explicit Measured(const char* n) : name(n) {}
    Measured(const Measured&) = delete;
    Measured& operator=(const Measured&) = delete;
    ~Measured() { ::testing::Test::RecordProperty(name, fmt::format("{:.3g}", value)); }
};

// Random numbers, the same everywhere.
using Random = std::mt19937_64;
inline double uniform(Random& random, double low = 0, double high = 1)
{
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}
inline double log_uniform(Random& random, double low, double high)
{
    return low * std::pow(high / low, uniform(random));
}
Vec3 random_direction(Random& random);
Vec3 random_in_box(Random& random, double half);

/// x as the precision holds it. volatile: GCC 12's vectorizer drops the way to float and back for two neighbours.
template <typename P>
double to_real(double x)
{
    const volatile typename P::real r = static_cast<typename P::real>(x);
    return r;
}
template <typename P>
Vec3 to_real(Vec3 v)
{
    return {to_real<P>(v.x), to_real<P>(v.y), to_real<P>(v.z)};
}

/// The direction in the core's own precision if its length is 1 to half an ulp, so that the core's renormalization
/// leaves it as it is.
template <typename P>
std::optional<Vec3> exact_direction(Vec3 d)
{
    const Vec3 r = to_real<P>(scene::unit(d));
    const Quad defect = 1 - (Quad(r.x) * r.x + Quad(r.y) * r.y + Quad(r.z) * r.z);
    if (defect >= Quad(P::u) || defect <= -Quad(P::u)) return std::nullopt;
    return r;
}

/// The square root in any type, Quad too (Newton's method, from long double).
template <typename W>
W root(W x)
{
    if (!(x > 0)) return 0;
    W s = std::sqrt(static_cast<long double>(x));
    for (int i = 0; i < 2; i++) s = (s + x / s) / 2;
    return s;
}

// Rays and pictures.
template <typename P>
std::optional<Hit> next_hit(const Native& scene, const Path& path, const std::vector<u32>& inside, Stats& stats)
{
    return P::surfaces(scene, std::array{Query{path, inside}}, stats)[0];
}

/// The path on the other side of the surface, in direction d; or on this side.
inline Path beyond(const Hit& hit, Vec3 d)
{
    return {hit.p, d, hit.left, hit.beyond_inside, hit.err};
}
inline Path back(const Hit& hit, Vec3 d)
{
    return {hit.p, d, hit.left, !hit.beyond_inside, hit.err};
}

/// The normal on the side that d comes from.
inline Vec3 facing(const Hit& hit, Vec3 d)
{
    return scene::dot(hit.n, d) > 0 ? -hit.n : hit.n;
}

/// The direction after a mirror, computed in long double and rounded once.
template <typename P>
Vec3 mirrored(Vec3 d, Vec3 n)
{
    const long double k = 2 * (static_cast<long double>(d.x) * n.x + static_cast<long double>(d.y) * n.y +
                               static_cast<long double>(d.z) * n.z);
    long double x = d.x - k * n.x, y = d.y - k * n.y, z = d.z - k * n.z;
    const long double s = 1 / std::sqrt(x * x + y * y + z * z);
    return to_real<P>({static_cast<double>(x * s), static_cast<double>(y * s), static_cast<double>(z * s)});
}

template <typename P>
Rgb trace(const Native& scene, Vec3 o, Vec3 d, Stats& stats)
{
    return P::traces(scene, std::array{Path{o, d}}, stats)[0];
}

/// What `sky rgb` shows, read back as the direction it stands for.
inline Vec3 direction_of(const Rgb& sky)
{
    return {2 * sky.r - 1, 2 * sky.g - 1, 1 - 2 * sky.b};
}

struct Image {
    unsigned width = 0, height = 0;
    std::vector<float> rgba;
    Stats stats{};
    Rgb at(unsigned x, unsigned y) const
    {
        const float* p = rgba.data() + 4 * (std::size_t{y} * width + x);
        return {p[0], p[1], p[2]};
    }
};

template <typename P>
Image render(const Scene& scene, View view)
{
    const Native native(scene, view);
    Image image{view.width, view.height, std::vector<float>(std::size_t{4} * view.width * view.height), {}};
    P::render(native, view, image.rgba.data(), image.stats);
    return image;
}

bool same_bits(const Image& a, const Image& b);
double rmse(const Image& a, const Image& b);

} // namespace clucida::test
