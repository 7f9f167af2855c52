#include "scene/linear.h"

namespace clucida::scene {

Mat3 rotation(Vec3 axis, double degrees)
{
    const Vec3 a = unit(axis);
    // Whole quarter turns are exact, so that turned blocks stay flush.
    const double quarters = degrees / 90;
    double c = std::cos(degrees * (M_PI / 180)), s = std::sin(degrees * (M_PI / 180));
    if (quarters == std::floor(quarters)) {
        const int q = static_cast<int>(std::fmod(quarters, 4)) & 3;
        c = q == 0 ? 1 : q == 2 ? -1 : 0;
        s = q == 1 ? 1 : q == 3 ? -1 : 0;
    }
    const auto column = [&](Vec3 v) { return v * c + cross(a, v) * s + a * (dot(a, v) * (1 - c)); };
    return transposed(Mat3{{column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})}});
}

namespace {
Affine affine(const Move& move)
{
    return {Mat3{}, move.by};
}
Affine affine(const Rotate& rotate)
{
    return {rotation(rotate.axis, rotate.degrees), {}};
}
Affine affine(const Scale& scale)
{
    return {Mat3{{Vec3{scale.by.x, 0, 0}, Vec3{0, scale.by.y, 0}, Vec3{0, 0, scale.by.z}}}, {}};
}
} // namespace

Affine affine_of(const std::variant<Move, Rotate, Scale>& transform)
{
    return std::visit([](const auto& t) { return affine(t); }, transform);
}

double uniform_scale(const Mat3& m)
{
    const Mat3 t = transposed(m);
    const double xx = dot(t.rows[0], t.rows[0]), yy = dot(t.rows[1], t.rows[1]), zz = dot(t.rows[2], t.rows[2]);
    const double off = std::fabs(dot(t.rows[0], t.rows[1])) + std::fabs(dot(t.rows[1], t.rows[2])) +
                       std::fabs(dot(t.rows[2], t.rows[0]));
    const double spread = std::fabs(xx - yy) + std::fabs(yy - zz);
    return off + spread <= 1e-12 * xx ? std::sqrt(xx) : 0;
}

} // namespace clucida::scene
