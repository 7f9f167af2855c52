/* Every other surface of second degree: cylinder, cone, paraboloid, hyperboloid, saddle, ellipsoid, in the frame that
 * makes its coefficients 0, 1 and -1 (layout.h). docs/numerics.md has the method. */
#ifndef CLUCIDA_QUADRIC_H
#define CLUCIDA_QUADRIC_H

#include "kernels/span.h"

/* Half the gradient at X, in the quadric's frame. */
static inline vec quadric_half_gradient(__global const LayoutQuadric* q, vec x)
{
    return make_vec(R(q->s[0]) * x.x, R(q->s[1]) * x.y, fma(R(q->s[2]), x.z, R(-q->g)));
}

static inline real quadric_slope(__global const LayoutQuadric* q, vec x, real half_derivative)
{
    const vec g = apply_transposed(q->m, quadric_half_gradient(q, x));
    return sqrt(dot3(g, g)) / fabs(half_derivative);
}

static inline real quadric_value(__global const LayoutQuadric* q, vec x)
{
    Sum sum = {R(q->w), R(0)};
    sum_product(&sum, R(q->s[0]) * x.x, x.x);
    sum_product(&sum, R(q->s[1]) * x.y, x.y);
    sum_product(&sum, fma(R(q->s[2]), x.z, R(-2) * R(q->g)), x.z);
    return sum_value(sum);
}

/* Leading coefficient: q along d. */
static inline real quadric_leading(__global const LayoutQuadric* q, vec d)
{
    Sum a = {R(0), R(0)};
    sum_product(&a, R(q->s[0]) * d.x, d.x);
    sum_product(&a, R(q->s[1]) * d.y, d.y);
    sum_product(&a, R(q->s[2]) * d.z, d.z);
    return sum_value(a);
}

/* B^2 - A C without its cancellation, from the direction d and the moment k about the frame's origin:
 * -(s0 s1 kz^2 + s1 s2 kx^2 + s0 s2 ky^2) - w A + g^2 dz^2 + 2 g (s0 dx ky - s1 dy kx). */
static inline real quadric_discriminant(__global const LayoutQuadric* q, vec d, vec k)
{
    const real s0 = R(q->s[0]), s1 = R(q->s[1]), s2 = R(q->s[2]), g = R(q->g), w = R(q->w);
    Sum s = {R(0), R(0)};
    sum_product(&s, -s0 * s1 * k.z, k.z);
    sum_product(&s, -s1 * s2 * k.x, k.x);
    sum_product(&s, -s0 * s2 * k.y, k.y);
    if (w != R(0)) {
        sum_product(&s, -w * s0 * d.x, d.x);
        sum_product(&s, -w * s1 * d.y, d.y);
        sum_product(&s, -w * s2 * d.z, d.z);
    }
    if (g != R(0)) {
        sum_product(&s, g * g * d.z, d.z);
        sum_product(&s, R(2) * g * s0 * d.x, k.y);
        sum_product(&s, R(-2) * g * s1 * d.y, k.x);
    }
    return sum_value(s);
}

/* A row of the frame times a vector that is known to twice the precision: v + lost. */
static inline Twofold quadric_coordinate(__global const float* row, vec v, vec lost)
{
    const vec m = load_vec(row);
    Sum s = {R(0), R(0)};
    sum_product(&s, m.x, v.x);
    sum_product(&s, m.y, v.y);
    sum_product(&s, m.z, v.z);
    s.error += dot3(m, lost);
    return sum_twofold(s);
}

/* The span of a quadric that the ray has just left, -2 B/A from its start. B fades as the ray grows flat, and A along
 * an asymptote or a generator; both keep their relative precision here. */
static inline Span quadric_span_left(__global const LayoutQuadric* q, const Line* line)
{
    const vec c = load_vec(q->c), none = make_vec(R(0), R(0), R(0));
    const vec o = sub(line->origin, c);
    const vec lost = make_vec(difference_error(line->origin.x, c.x), difference_error(line->origin.y, c.y),
                              difference_error(line->origin.z, c.z));
    Sum a = {R(0), R(0)}, b = {R(0), R(0)};
    for (int i = 0; i < 3; i++) {
        const Twofold x = quadric_coordinate(q->m + 3 * i, o, lost),
                      v = quadric_coordinate(q->m + 3 * i, line->d, none);
        const Twofold part = {R(q->s[i]) * v.hi, R(q->s[i]) * v.lo}; /* exact: s is 0, 1 or -1 */
        sum_twofold_product(&a, part, v);
        sum_twofold_product(&b, part, x);
        if (i == 2) {
            const Twofold g = {R(-q->g), R(0)};
            sum_twofold_product(&b, g, v);
        }
    }
    const Twofold leading = sum_twofold(a), product = sum_twofold(b), twice = {R(-2) * product.hi, R(-2) * product.lo};
    const real other = leading.hi == R(0) ? R(0) : twofold_ratio(twice, leading);
    /* What the start is off the surface shifts the other end by as much along the line. */
    const vec x = apply(q->m, o);
    const real slope =
        fmax(quadric_slope(q, x, product.hi), quadric_slope(q, along(x, apply(q->m, line->d), other), product.hi));
    return span_left(line, leading.hi, other, slope);
}

static inline Span quadric_span(__global const LayoutQuadric* q, const Line* line, int left)
{
    if (left) return quadric_span_left(q, line);
    const vec c = load_vec(q->c);
    const vec d = apply(q->m, line->d);
    const real a = quadric_leading(q, d);
    const vec o = sub(line->base, c);
    const vec moment = cross_exact(o, line->d);
#ifdef CLU_DOUBLE
    /* The stored cofactors are rounded: too coarse for double. */
    const vec m0 = load_vec(q->m), m1 = load_vec(q->m + 3), m2 = load_vec(q->m + 6);
    const vec k = make_vec(dot3(cross_exact(m1, m2), moment), dot3(cross_exact(m2, m0), moment),
                           dot3(cross_exact(m0, m1), moment));
#else
    const vec k = apply(q->cof, moment);
#endif
    const real discriminant = quadric_discriminant(q, d, k);
    if (!(discriminant > R(0)) && a != R(0)) return a < R(0) ? span_everything() : span_nothing();

    /* A, B, C at the line's point nearest to the frame's origin. */
    const real dd = dot3(d, d);
    const real nearest = -dot3(apply(q->m, o), d) / dd;
    const vec x = scaled(cross_exact(d, k), R(1) / dd);
    const vec gradient = quadric_half_gradient(q, x);
    const real b = dot3(gradient, d);
    const real value = quadric_value(q, x);

    if (!(discriminant > R(0))) return value < R(0) ? span_everything() : span_nothing();
    const real root = sqrt(discriminant);
    const real s = -(b + copysign(root, b));
    const real t1 = value / s;
    Span span;
    if (a == R(0)) {
        span = b > R(0) ? make_span(-INFINITE, t1, R(0), 1) : make_span(t1, INFINITE, R(0), 1);
    } else {
        const real t2 = s / a;
        span = make_span(fmin(t1, t2), fmax(t1, t2), R(0), a > R(0));
    }
    if (is_finite(span.lo)) span.slope_lo = quadric_slope(q, along(x, d, span.lo), root);
    if (is_finite(span.hi)) span.slope_hi = quadric_slope(q, along(x, d, span.hi), root);
    span.lo += nearest;
    span.hi += nearest;
    return span;
}

/* Outward normal; *p makes one Newton step onto the surface. At a singular point (a cone's apex) any unit vector. */
static inline vec quadric_normal(__global const LayoutQuadric* q, vec* p)
{
    const vec x = apply(q->m, sub(*p, load_vec(q->c)));
    const vec g = apply_transposed(q->m, quadric_half_gradient(q, x));
    const real gg = dot3(g, g);
    if (!(gg > R(0))) return make_vec(R(0), R(0), R(1));
    *p = along(*p, g, R(-0.5f) * quadric_value(q, x) / gg);
    return renormalized(scaled(g, R(1) / sqrt(gg)));
}

#endif
