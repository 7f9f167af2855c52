/* The naive variant of the half-space behind a plane. */
#ifndef CLUCIDA_PLANE_H
#define CLUCIDA_PLANE_H

#include "kernels/span.h"
#include "kernels/wide.h"

static inline Span plane_span(__global const LayoutPlane* plane, const Line* line, int left)
{
    const vec n = load_vec(plane->n);
    const real nd = dot3(n, line->d), height = dot3(n, line->base) - R(plane->h);
    (void)left;
    if (nd == R(0)) return height < R(0) ? span_everything() : span_nothing();
    const real t = -height / nd;
    return nd < R(0) ? make_span(t, INFINITE, R(1), 1) : make_span(-INFINITE, t, R(1), 1);
}

static inline void plane_block_ends(__global const LayoutPlaneBlock* block, const Line* line, wide* lo, wide* hi)
{
    const wide x = load_wide(block->n[0]), y = load_wide(block->n[1]), z = load_wide(block->n[2]);
    const wide nd = wide_fma(x, wide_all(line->d.x), wide_fma(y, wide_all(line->d.y), z * wide_all(line->d.z)));
    const wide n_base =
        wide_fma(x, wide_all(line->base.x), wide_fma(y, wide_all(line->base.y), z * wide_all(line->base.z)));
    const wide height = n_base - load_wide(block->h), zero = wide_all(R(0)), infinite = wide_all(INFINITE);
    const wide t = -height / nd, beside = wide_select(infinite, -infinite, height < zero);
    *lo = wide_select(wide_select(beside, -infinite, nd > zero), t, nd < zero);
    *hi = wide_select(infinite, t, nd > zero);
}

static inline real plane_slope(__global const LayoutPlane* plane, const Line* line, int left)
{
    (void)plane;
    (void)line;
    (void)left;
    return R(1);
}

static inline vec plane_normal(__global const LayoutPlane* plane, vec* p)
{
    (void)p;
    return load_vec(plane->n);
}

#endif
