/* The ball |p - c| < r. */
#ifndef CLUCIDA_SPHERE_H
#define CLUCIDA_SPHERE_H

#include "kernels/span.h"

/* The discriminant comes from the moment k = (o - c) x d, which does not cancel: r^2 |d|^2 - |k|^2. */
static inline Span sphere_span(__global const LayoutSphere* sphere, const Line* line, int left)
{
    const vec c = load_vec(sphere->c);
    const real r = R(sphere->r);
    if (left) {
        if (!line->left_inside) return span_left(line);
        const real b = dot_exact(sub(line->origin, c), line->d), chord = R(-2) * b;
        return span_chord(line, line->start + over_square(chord, line->excess), r / fabs(b));
    }
    const vec o = sub(line->base, c);
    const vec k = cross_exact(o, line->d);
    const real discriminant = fma(r * r, line->excess, fma(r, r, -dot3(k, k)));
    if (!(discriminant > R(0))) return span_nothing();
    const real root = sqrt(discriminant);
    const real t = over_square(-dot3(o, line->d), line->excess);
    const real half_chord = over_square(root, line->excess);
    return make_span(t - half_chord, t + half_chord, r / root, 1);
}

static inline vec sphere_normal(__global const LayoutSphere* sphere, vec* p)
{
    const vec c = load_vec(sphere->c);
    const vec n = unit(sub(*p, c));
    *p = along(c, n, R(sphere->r));
    return n;
}

#endif
