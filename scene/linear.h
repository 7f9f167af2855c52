/// Linear algebra in double: what the scene compiler needs of it.
#pragma once

#include "scene/model.h"

#include <array>
#include <cmath>

namespace clucida::scene {

inline Vec3 operator+(Vec3 a, Vec3 b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(Vec3 a)
{
    return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(Vec3 a, double s)
{
    return {a.x * s, a.y * s, a.z * s};
}
inline double dot(Vec3 a, Vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a)
{
    return std::hypot(a.x, a.y, a.z);
}
inline Vec3 unit(Vec3 a)
{
    return a * (1 / length(a));
}
inline double component(Vec3 a, int i)
{
    return i == 0 ? a.x : i == 1 ? a.y : a.z;
}

/// Row-major: rows[i] is row i.
struct Mat3 {
    std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
};

inline Vec3 operator*(const Mat3& m, Vec3 v)
{
    return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}
inline Mat3 transposed(const Mat3& m)
{
    const auto& r = m.rows;
    return {{Vec3{r[0].x, r[1].x, r[2].x}, Vec3{r[0].y, r[1].y, r[2].y}, Vec3{r[0].z, r[1].z, r[2].z}}};
}
inline Mat3 operator*(const Mat3& a, const Mat3& b)
{
    const Mat3 t = transposed(b);
    return {{t * a.rows[0], t * a.rows[1], t * a.rows[2]}};
}
inline double determinant(const Mat3& m)
{
    return dot(m.rows[0], cross(m.rows[1], m.rows[2]));
}
/// Transforms cross products as m transforms vectors.
inline Mat3 cofactor(const Mat3& m)
{
    const auto& r = m.rows;
    return {{cross(r[1], r[2]), cross(r[2], r[0]), cross(r[0], r[1])}};
}
inline Mat3 inverse(const Mat3& m)
{
    Mat3 t = transposed(cofactor(m));
    const double s = 1 / determinant(m);
    for (Vec3& row : t.rows) row = row * s;
    return t;
}

/// p -> linear p + offset.
struct Affine {
    Mat3 linear;
    Vec3 offset;
};

inline Vec3 operator*(const Affine& a, Vec3 p)
{
    return a.linear * p + a.offset;
}
inline Affine operator*(const Affine& a, const Affine& b)
{
    return {a.linear * b.linear, a * b.offset};
}

/// Right-handed rotation by an angle in degrees about an axis through the origin (Rodrigues).
Mat3 rotation(Vec3 axis, double degrees);
Affine affine_of(const std::variant<Move, Rotate, Scale>& transform);

/// The factor by which the map scales all lengths, if it does so alike in every direction; else 0.
double uniform_scale(const Mat3& m);

} // namespace clucida::scene
