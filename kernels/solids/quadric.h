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

static inline Span quadric_span(__global const LayoutQuadric* q, const Line* line, int left)
{
    const vec c = load_vec(q->c);
    const vec d = apply(q->m, line->d);
    const real a = quadric_leading(q, d);
    if (left) {
        const vec x = apply(q->m, sub(line->origin, c));
        const real b = dot3(quadric_half_gradient(q, x), d);
        const real other = a == R(0) ? R(0) : R(-2) * b / a;
        /* What the start is off the surface shifts the other end by as much along the line. */
        const real slope = fmax(quadric_slope(q, x, b), quadric_slope(q, along(x, d, other), b));
        return span_left(line, a, other, slope);
    }
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
