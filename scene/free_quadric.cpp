#include "scene/free_quadric.h"

#include <algorithm>

namespace clucida::scene {
namespace {

/// Against the largest of its kind less than this is nothing: what rounding leaves of a sum that should be 0.
constexpr double nothing = 1e-12;

using Matrix = std::array<std::array<double, 3>, 3>;

/// A term of second degree, value y^2, of the coordinate y along a direction; slope is half its coefficient of y.
struct Term {
    double value = 0, slope = 0;
    Vec3 direction;
};

/// Turns coordinates i and j so that a[i][j] becomes 0 (Jacobi; Golub and Van Loan, Matrix Computations, 8.5).
void turn(Matrix& a, std::array<Vec3, 3>& axes, std::size_t i, std::size_t j)
{
    if (a[i][j] == 0) return;
    const double theta = (a[j][j] - a[i][i]) / (2 * a[i][j]);
    const double t = std::copysign(1 / (std::fabs(theta) + std::hypot(theta, 1)), theta);
    const double c = 1 / std::hypot(t, 1), s = t * c;
    for (std::size_t k = 0; k < 3; k++) {
        const double x = a[k][i], y = a[k][j];
        a[k][i] = c * x - s * y;
        a[k][j] = s * x + c * y;
    }
    for (std::size_t k = 0; k < 3; k++) {
        const double x = a[i][k], y = a[j][k];
        a[i][k] = c * x - s * y;
        a[j][k] = s * x + c * y;
    }
    a[i][j] = a[j][i] = 0;
    const Vec3 x = axes[i], y = axes[j];
    axes[i] = x * c - y * s;
    axes[j] = x * s + y * c;
}

/// The terms along the principal axes, those without a value last.
std::array<Term, 3> principal_terms(const FreeQuadric& quadric)
{
    const auto& q = quadric.q;
    Matrix a{{{q[0], q[3] / 2, q[4] / 2}, {q[3] / 2, q[1], q[5] / 2}, {q[4] / 2, q[5] / 2, q[2]}}};
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (int sweep = 0; sweep < 16; sweep++) { // converges within five or so
        turn(a, axes, 0, 1);
        turn(a, axes, 0, 2);
        turn(a, axes, 1, 2);
    }
    const double largest = std::max({std::fabs(a[0][0]), std::fabs(a[1][1]), std::fabs(a[2][2])});
    const Vec3 half = Vec3{q[6], q[7], q[8]} * 0.5;
    std::array<Term, 3> terms;
    for (std::size_t i = 0; i < 3; i++) {
        const double value = std::fabs(a[i][i]) > nothing * largest ? a[i][i] : 0;
        double slope = dot(half, axes[i]);
        if (std::fabs(slope) <= nothing * length(half)) slope = 0;
        terms[i] = {value, slope, axes[i]};
    }
    std::ranges::stable_sort(terms, [](const Term& x, const Term& y) { return (x.value != 0) > (y.value != 0); });
    return terms;
}

double sign(double x)
{
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// The sum of value y^2, and w.
std::optional<Quadric> central(const std::array<Term, 3>& terms, Vec3 center, double w)
{
    Quadric q;
    q.c = center;
    q.w = sign(w);
    q.s = {sign(terms[0].value), sign(terms[1].value), sign(terms[2].value)};
    const Vec3 s = q.s;
    double largest = 0;
    for (const Term& t : terms) largest = std::max(largest, std::fabs(t.value));
    const double low = std::min({s.x, s.y, s.z}), high = std::max({s.x, s.y, s.z});
    if ((low >= 0 && q.w >= 0) || (high <= 0 && q.w <= 0)) return std::nullopt;
    for (std::size_t i = 0; i < 3; i++) {
        // Where nothing changes any scale will do that leaves the frame well shaped.
        const double value = terms[i].value != 0 ? std::fabs(terms[i].value) : largest;
        q.m.rows[i] = terms[i].direction * std::sqrt(value / (w != 0 ? std::fabs(w) : largest));
    }
    q.convex = low >= 0;
    return q;
}

/// The sum of value y^2 of the first two, and 2 slope y of the last.
Quadric parabolic(const std::array<Term, 3>& terms, Vec3 vertex, double slope)
{
    const double size = std::max(std::fabs(terms[0].value), std::fabs(terms[1].value));
    const double scale = size / slope; // divide by slope^2 / size: X2 = -y size / slope
    Quadric q;
    q.c = vertex;
    q.g = 1;
    q.s = {sign(terms[0].value), sign(terms[1].value), 0};
    for (std::size_t i = 0; i < 2; i++) {
        const double value = terms[i].value != 0 ? terms[i].value : terms[0].value;
        q.m.rows[i] = terms[i].direction * (std::sqrt(std::fabs(value) / size) * std::fabs(scale));
    }
    q.m.rows[2] = terms[2].direction * -scale;
    q.convex = q.s.x >= 0 && q.s.y >= 0;
    return q;
}

HalfSpace half_space(Vec3 point, Vec3 normal)
{
    const Vec3 n = unit(normal);
    return {n, dot(n, point)};
}

/// X0^2 - X2^2 < 0, X0^2 - 1 < 0 or 1 - X2^2 < 0.
std::optional<PlanePair> plane_pair(const Quadric& q)
{
    const auto& x = q.m.rows;
    if (q.s == Vec3{1, 0, -1} && q.w == 0)
        return PlanePair{half_space(q.c, x[0] - x[2]), half_space(q.c, x[0] + x[2]), true, false};
    const bool slab = q.s == Vec3{1, 0, 0}, outside = q.s == Vec3{0, 0, -1};
    if (!slab && !outside) return std::nullopt;
    const Vec3 normal = slab ? x[0] : x[2], half = normal * (1 / dot(normal, normal));
    return PlanePair{half_space(q.c + half, normal), half_space(q.c - half, -normal), false, outside};
}

/// The solid of revolution that holds it, for its bounds.
std::optional<Quadric::Revolution> revolution_of(Quadric& q)
{
    const auto radius = [&](std::size_t i) { return 1 / length(q.m.rows[i]); };
    const double widest = std::max(radius(0), radius(1));
    if (q.g != 0 && q.s == Vec3{1, 1, 0}) {
        const double k = length(q.m.rows[2]);
        return Quadric::Revolution{q.m.rows[2] * (1 / k), 0, 0, widest * widest * k / 2};
    }
    if (q.g == 0 && q.s.x > 0 && q.s.y > 0 && q.s.z <= 0) {
        const double waist = q.w < 0 ? widest : 0, slope = q.s.z < 0 ? widest / radius(2) : 0;
        return Quadric::Revolution{unit(q.m.rows[2]), waist, slope, 0};
    }
    return std::nullopt;
}

} // namespace

std::optional<std::variant<HalfSpace, PlanePair, Quadric>> canonical(const FreeQuadric& quadric)
{
    std::array<Term, 3> terms = principal_terms(quadric);
    const double constant = quadric.q[9];
    double w = constant, size = std::fabs(constant);
    Vec3 center;
    for (const Term& t : terms) { // completes the squares
        if (t.value == 0) continue;
        center = center - t.direction * (t.slope / t.value);
        w -= t.slope * t.slope / t.value;
        size += t.slope * t.slope / std::fabs(t.value);
    }
    if (std::fabs(w) <= nothing * size) w = 0;
    // What is left of first degree runs along one direction; terms without a value turn towards it.
    Vec3 rest;
    for (const Term& t : terms)
        if (t.value == 0) rest = rest + t.direction * t.slope;
    const double slope = length(rest);
    if (slope == 0) {
        // The axis that differs in sign comes last, as a solid of revolution has it.
        std::ranges::stable_sort(terms, [](const Term& x, const Term& y) { return x.value > y.value; });
        std::optional<Quadric> q = central(terms, center, w);
        if (!q) return std::nullopt;
        if (const auto planes = plane_pair(*q)) return *planes;
        q->revolution = revolution_of(*q);
        return *q;
    }
    const Vec3 along = rest * (1 / slope);
    if (terms[0].value == 0) return HalfSpace{along, -constant / (2 * slope)};
    terms[2] = {0, slope, along};
    if (terms[1].value == 0) terms[1].direction = cross(along, terms[0].direction);
    Quadric q = parabolic(terms, center - along * (w / (2 * slope)), slope);
    q.revolution = revolution_of(q);
    return q;
}

bool has_boundary(const FreeQuadric& quadric)
{
    return canonical(quadric).has_value();
}

} // namespace clucida::scene
