/// Vectors and matrices of any real type.
#pragma once

#include "bench/oracle/real.h"
#include "scene/model.h"

#include <array>
#include <cstddef>

namespace clucida::oracle {

template <class Real>
struct Vec {
    Real x = 0, y = 0, z = 0;
};

template <class To, class From>
Vec<To> converted(const Vec<From>& v)
{
    return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}
template <class Real>
Vec<Real> vec(const scene::Vec3& v)
{
    return {Real(v.x), Real(v.y), Real(v.z)};
}

template <class Real>
Vec<Real> operator+(const Vec<Real>& a, const Vec<Real>& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
Vec<Real> operator-(const Vec<Real>& a, const Vec<Real>& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
Vec<Real> operator-(const Vec<Real>& a)
{
    return {-a.x, -a.y, -a.z};
}
template <class Real>
Vec<Real> operator*(const Vec<Real>& a, const Real& s)
{
    return {a.x * s, a.y * s, a.z * s};
}
template <class Real>
Real dot(const Vec<Real>& a, const Vec<Real>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Vec<Real> cross(const Vec<Real>& a, const Vec<Real>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
Real length(const Vec<Real>& a)
{
    return sqrt(dot(a, a));
}
template <class Real>
Vec<Real> unit(const Vec<Real>& a)
{
    return a * (Real(1) / length(a));
}
/// The sum of the magnitudes: a cheap size.
template <class Real>
double size_of(const Vec<Real>& a)
{
    return std::fabs(to_double(a.x)) + std::fabs(to_double(a.y)) + std::fabs(to_double(a.z));
}

/// By rows.
template <class Real>
struct Mat {
    Vec<Real> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

template <class Real>
Vec<Real> operator*(const Mat<Real>& m, const Vec<Real>& v)
{
    return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}
template <class Real>
Mat<Real> transposed(const Mat<Real>& m)
{
    return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}};
}
template <class Real>
Mat<Real> operator*(const Mat<Real>& a, const Mat<Real>& b)
{
    const Mat<Real> t = transposed(b);
    return {t * a.x, t * a.y, t * a.z};
}
template <class Real>
Mat<Real> inverse(const Mat<Real>& m)
{
    const Vec<Real> yz = cross(m.y, m.z), zx = cross(m.z, m.x), xy = cross(m.x, m.y);
    const Real s = Real(1) / dot(m.x, yz);
    return transposed(Mat<Real>{yz * s, zx * s, xy * s});
}

/// p -> linear p + offset.
template <class Real>
struct Affine {
    Mat<Real> linear;
    Vec<Real> offset;
};

/// The frame of a mapping or a sky whose pole is n (docs/scene-language.md): X = (cos theta cos phi, cos theta sin phi,
/// -sin theta), Y = (-sin phi, cos phi, 0), Z = n/|n|, with phi = 0 where n lies along z.
template <class Real>
Mat<Real> pole_frame(const Vec<Real>& n)
{
    const Vec<Real> z = unit(n);
    const Real sin_theta = sqrt(z.x * z.x + z.y * z.y);
    const Real cos_phi = sin_theta > 0 ? z.x / sin_theta : Real(1);
    const Real sin_phi = sin_theta > 0 ? z.y / sin_theta : Real(0);
    return {{z.z * cos_phi, z.z * sin_phi, -sin_theta}, {-sin_phi, cos_phi, Real(0)}, z};
}

/// A frame whose z lies along the axis, for solids of revolution.
template <class Real>
Mat<Real> axis_frame(const Vec<Real>& axis)
{
    return pole_frame(axis);
}

/// A frame with z along the axis, x as near to the given direction as may be, y = z cross x.
template <class Real>
Mat<Real> axis_frame(const Vec<Real>& axis, const Vec<Real>& x)
{
    const Vec<Real> z = unit(axis);
    const Vec<Real> right = unit(x - z * dot(x, z));
    return {right, cross(z, right), z};
}

} // namespace clucida::oracle
