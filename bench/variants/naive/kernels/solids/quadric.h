/* The naive variant of the quadrics: the ray brought into the quadric's frame, and the quadratic formula. */
#ifndef CLUCIDA_QUADRIC_H
#define CLUCIDA_QUADRIC_H

#include "kernels/span.h"

static inline Span quadric_span(__global const LayoutQuadric* q, const Line* line, int left)
{
    const vec o = apply(q->m, sub(line->base, load_vec(q->c))), d = apply(q->m, line->d);
    const vec s = load_vec(q->s), sd = make_vec(s.x * d.x, s.y * d.y, s.z * d.z);
    const vec so = make_vec(s.x * o.x, s.y * o.y, s.z * o.z);
    const real g = R(q->g), a = dot3(sd, d), b = R(2) * (dot3(sd, o) - g * d.z);
    const real c = dot3(so, o) - R(2) * g * o.z + R(q->w);
    (void)left;
    if (a == R(0)) {
        if (b == R(0)) return c < R(0) ? span_everything() : span_nothing();
        return b > R(0) ? make_span(-INFINITE, -c / b, R(1), 1) : make_span(-c / b, INFINITE, R(1), 1);
    }
    const real discriminant = b * b - R(4) * a * c;
    if (!(discriminant > R(0))) return a < R(0) ? span_everything() : span_nothing();
    const real root = sqrt(discriminant), over = R(0.5f) / a;
    const real t1 = (-b - root) * over, t2 = (-b + root) * over;
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
