/// One random solid of each kind of primitive: any orientation, any size from 2^-13 to 2^20, slender to a factor of
/// ten.
#pragma once

#include "quadric_of.h"

#include <numbers>

namespace clucida::test {

/// A solid about the eye, with the length that its rays and its errors are measured in.
struct SizedSolid {
    SolidPtr solid;
    double size = 1;
};

struct Kind {
    const char* name;
    SolidPtr (*make)(Random& random, Vec3 center, double size);
    double most_units = 8; ///< error x cos <= so many u x size
};

inline constexpr double least_size = 0x1p-13, greatest_size = 0x1p20;

inline Vec3 random_axis(Random& random, double least, double greatest)
{
    return random_direction(random) * log_uniform(random, least, greatest);
}

/// A free quadric of semi-axes between a fifth of the size and the size.
inline SolidPtr free_quadric(Random& r, Vec3 c, double size, Vec3 s, Vec3 l, double w)
{
    scene::Mat3 m = scene::rotation(random_direction(r), uniform(r, 0, 360));
    for (Vec3& row : m.rows) row = row * (1 / log_uniform(r, .2 * size, size));
    return quadric_of(m, c, s, l, w);
}

/// Every kind of primitive. test_kernels.cmake names them too.
inline constexpr std::array kinds{
    Kind{"plane", [](Random& r, Vec3 c, double) { return plane(c, random_direction(r)); }},
    Kind{"sphere", [](Random&, Vec3 c, double s) { return sphere(c, s); }},
    Kind{"cylinder",
         [](Random& r, Vec3 c, double s) {
             return solid(scene::Cylinder{c, random_direction(r) * s});
         }},
    Kind{"cone",
         [](Random& r, Vec3 c, double) {
             return solid(scene::Cone{c, random_axis(r, .1, 10)});
         }},
    Kind{"paraboloid",
         [](Random& r, Vec3 c, double s) {
             return solid(scene::Paraboloid{c, random_axis(r, .05 * s, .5 * s)});
         }},
    Kind{"hyperboloid",
         [](Random& r, Vec3 c, double s) {
             return solid(scene::Hyperboloid{c, random_axis(r, .1 * s, s), log_uniform(r, .1 * s, s)});
         }},
    Kind{"saddle",
         [](Random& r, Vec3 c, double s) {
             return solid(scene::Saddle{c, random_axis(r, .5 / s, 5 / s), random_direction(r)});
         }},
    Kind{"cuboid",
         [](Random& r, Vec3 c, double s) {
             const double x = log_uniform(r, .2 * s, 2 * s), y = log_uniform(r, .2 * s, 2 * s);
             return solid(scene::Cuboid{c, random_direction(r), random_direction(r), {x, y, 2 * s}});
         }},
    Kind{"ellipsoid",
         [](Random& r, Vec3 c, double s) {
             const double x = log_uniform(r, .1 * s, s), y = log_uniform(r, .1 * s, s);
             const SolidPtr scaled = solid(scene::Transformed{scene::Scale{{x, y, s}}, sphere({0, 0, 0}, 1)});
             const SolidPtr turned =
                 solid(scene::Transformed{scene::Rotate{random_direction(r), uniform(r, 0, 360)}, scaled});
             return solid(scene::Transformed{scene::Move{c}, turned});
         }},
    Kind{"torus",
         [](Random& r, Vec3 c, double s) {
             const double minor = log_uniform(r, .02 * s, .49 * s);
             return solid(scene::Torus{c, random_direction(r), s - minor, minor});
         },
         16},
    Kind{"free_ellipsoid",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, 1, 1}, {}, -1);
         }},
    Kind{"one_sheet",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, 1, -1}, {}, -1);
         }},
    Kind{"two_sheets",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, 1, -1}, {}, 1);
         }},
    Kind{"elliptic_cone",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, 1, -1}, {}, 0);
         }},
    Kind{"elliptic_paraboloid",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, 1, 0}, {0, 0, -1}, 0);
         }},
    Kind{"hyperbolic_paraboloid",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, -1, 0}, {0, 0, -1}, 0);
         }},
    Kind{"elliptic_cylinder",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, 1, 0}, {}, -1);
         }},
    Kind{"hyperbolic_cylinder",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, -1, 0}, {}, 1);
         }},
    Kind{"parabolic_cylinder",
         [](Random& r, Vec3 c, double s) {
             return free_quadric(r, c, s, {1, 0, 0}, {0, 0, -1}, 0);
         }},
};

/// The centre is the eye, or lies about a size from it; one solid in four is a complement.
inline SizedSolid random_solid(Random& random, const Kind& kind)
{
    SizedSolid s;
    s.size = log_uniform(random, least_size, greatest_size);
    const Vec3 center = random() % 2 == 0 ? Vec3{0, 0, 0} : random_in_box(random, s.size);
    s.solid = kind.make(random, center, s.size);
    if (random() % 4 == 0) s.solid = complement(s.solid);
    return s;
}

} // namespace clucida::test
