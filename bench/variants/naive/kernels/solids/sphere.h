/* The naive variant of the ball: the quadratic formula. */
#ifndef CLUCIDA_SPHERE_H
#define CLUCIDA_SPHERE_H

#include "kernels/span.h"

static inline Span sphere_span(__global const LayoutSphere* sphere, const Line* line, int left)
{
    const real r = R(sphere->r);
    const vec o = sub(line->base, load_vec(sphere->c));
    const real a = dot3(line->d, line->d), b = R(2) * dot3(o, line->d), c = dot3(o, o) - r * r;
    const real discriminant = b * b - R(4) * a * c;
    (void)left;
    if (!(discriminant > R(0))) return span_nothing();
    const real root = sqrt(discriminant), over = R(0.5f) / a;
    return make_span((-b - root) * over, (-b + root) * over, R(1), 1);
}

static inline vec sphere_normal(__global const LayoutSphere* sphere, vec* p)
{
    return normalized(sub(*p, load_vec(sphere->c)));
}

#endif
