/* The re-origined variant of the ball: the discriminant is r^2 |d|^2 - |k|^2, k = (o - c) x d. */
#ifndef CLUCIDA_SPHERE_H
#define CLUCIDA_SPHERE_H

#include "kernels/cross.h"
#include "kernels/span.h"

static inline Span sphere_span(__global const LayoutSphere* sphere, const Line* line, int left)
{
    const real r = R(sphere->r);
    const vec o = sub(line->base, load_vec(sphere->c)), k = cross3(o, line->d);
    const real dd = dot3(line->d, line->d), discriminant = r * r * dd - dot3(k, k);
    (void)left;
    if (!(discriminant > R(0))) return span_nothing();
    const real middle = -dot3(o, line->d) / dd, half_chord = sqrt(discriminant) / dd;
    return make_span(middle - half_chord, middle + half_chord, R(1), 1);
}

static inline vec sphere_normal(__global const LayoutSphere* sphere, vec* p)
{
    return normalized(sub(*p, load_vec(sphere->c)));
}

#endif
