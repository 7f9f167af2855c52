/* The re-origined variant of the quadrics: the quadratic formula at the line's point nearest to the frame's origin, the
 * discriminant from the moment (kernels/solids/quadric.h has the formula), all in plain arithmetic. */
#ifndef CLUCIDA_QUADRIC_H
#define CLUCIDA_QUADRIC_H

#include "kernels/cross.h"
#include "kernels/span.h"

static inline real quadric_discriminant(__global const LayoutQuadric* q, vec d, vec k, real a)
{
    const real s0 = R(q->s[0]), s1 = R(q->s[1]), s2 = R(q->s[2]), g = R(q->g);
    return g * g * d.z * d.z + R(2) * g * (s0 * d.x * k.y - s1 * d.y * k.x) -
           (s0 * s1 * k.z * k.z + s1 * s2 * k.x * k.x + s0 * s2 * k.y * k.y) - R(q->w) * a;
}

static inline Span quadric_span(__global const LayoutQuadric* q, const Line* line, int left)
{
    const vec o = sub(line->base, load_vec(q->c)), d = apply(q->m, line->d);
    const vec s = load_vec(q->s), sd = make_vec(s.x * d.x, s.y * d.y, s.z * d.z);
    const vec y = apply(q->m, o), k = cross3(y, d);
    const real g = R(q->g), a = dot3(sd, d), dd = dot3(d, d);
    (void)left;

    const real nearest = -dot3(y, d) / dd;
    const vec x = scaled(cross3(d, k), R(1) / dd);
    const real b = dot3(sd, x) - g * d.z; /* half of the textbooks' b */
    const real c = R(q->s[0]) * x.x * x.x + R(q->s[1]) * x.y * x.y + (R(q->s[2]) * x.z - R(2) * g) * x.z + R(q->w);
    if (a == R(0)) {
        if (b == R(0)) return c < R(0) ? span_everything() : span_nothing();
        const real t = nearest - R(0.5f) * c / b;
        return b > R(0) ? make_span(-INFINITE, t, R(1), 1) : make_span(t, INFINITE, R(1), 1);
    }
    const real discriminant = quadric_discriminant(q, d, k, a);
    if (!(discriminant > R(0))) return a < R(0) ? span_everything() : span_nothing();
    const real root = sqrt(discriminant);
    const real t1 = nearest + (-b - root) / a, t2 = nearest + (-b + root) / a;
    return make_span(fmin(t1, t2), fmax(t1, t2), R(1), a > R(0));
}

static inline vec quadric_normal(__global const LayoutQuadric* q, vec* p)
{
    const vec x = apply(q->m, sub(*p, load_vec(q->c)));
    const vec g = make_vec(R(q->s[0]) * x.x, R(q->s[1]) * x.y, R(q->s[2]) * x.z - R(q->g));
    const vec n = apply_transposed(q->m, g);
    return dot3(n, n) > R(0) ? normalized(n) : make_vec(R(0), R(0), R(1));
}

#endif
