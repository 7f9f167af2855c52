/* The half-space behind a plane: dot(n, p) < h. */
#ifndef CLUCIDA_PLANE_H
#define CLUCIDA_PLANE_H

#include "kernels/span.h"

static inline Span plane_span(__global const LayoutPlane* plane, const Line* line, int left)
{
    if (left) return span_left(line);
    const vec n = load_vec(plane->n);
    const real nd = dot3(n, line->d);
    const real height = dot3(n, line->base) - R(plane->h);
    if (nd == R(0)) return height < R(0) ? span_everything() : span_nothing();
    /* -height / nd, of whose quotient a step of Newton's makes up for what the reciprocal has lost. */
    const real reciprocal = R(1) / nd, quotient = -height * reciprocal;
    const real t = fma(-fma(quotient, nd, height), reciprocal, quotient);
    const real slope = fabs(reciprocal);
    return nd < R(0) ? make_span(t, INFINITE, slope, 1) : make_span(-INFINITE, t, slope, 1);
}

/* Outward normal; *p moves onto the surface. */
static inline vec plane_normal(__global const LayoutPlane* plane, vec* p)
{
    const vec n = load_vec(plane->n);
    *p = along(*p, n, (R(plane->h) - dot3(n, *p)) / dot3(n, n));
    return unit(n); /* stored to float, which is not unit enough for double */
}

#endif
