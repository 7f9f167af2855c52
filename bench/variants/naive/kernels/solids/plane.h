/* The naive variant of the half-space behind a plane. */
#ifndef CLUCIDA_PLANE_H
#define CLUCIDA_PLANE_H

#include "kernels/span.h"

static inline Span plane_span(__global const LayoutPlane* plane, const Line* line, int left)
{
    const vec n = load_vec(plane->n);
    const real nd = dot3(n, line->d), height = dot3(n, line->base) - R(plane->h);
    (void)left;
    if (nd == R(0)) return height < R(0) ? span_everything() : span_nothing();
    const real t = -height / nd;
    return nd < R(0) ? make_span(t, INFINITE, R(1), 1) : make_span(-INFINITE, t, R(1), 1);
}

static inline vec plane_normal(__global const LayoutPlane* plane, vec* p)
{
    (void)p;
    return load_vec(plane->n);
}

#endif
