/* The half-space behind a plane: dot(n, p) < h. */
#ifndef CLUCIDA_PLANE_H
#define CLUCIDA_PLANE_H

#include "kernels/span.h"
#include "kernels/wide.h"

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

/* Where a line enters and leaves eight half-spaces at once, each as in plane_span. */
static inline void plane_block_ends(__global const LayoutPlaneBlock* block, const Line* line, wide* lo, wide* hi)
{
    const wide x = load_wide(block->n[0]), y = load_wide(block->n[1]), z = load_wide(block->n[2]);
    const wide nd = wide_fma(x, wide_all(line->d.x), wide_fma(y, wide_all(line->d.y), z * wide_all(line->d.z)));
    const wide n_base =
        wide_fma(x, wide_all(line->base.x), wide_fma(y, wide_all(line->base.y), z * wide_all(line->base.z)));
    const wide height = n_base - load_wide(block->h), zero = wide_all(R(0)), infinite = wide_all(INFINITE);
    const wide reciprocal = wide_all(R(1)) / nd, quotient = -height * reciprocal;
    const wide t = wide_fma(-wide_fma(quotient, nd, height), reciprocal, quotient);
    const wide beside = wide_select(infinite, -infinite, height < zero); /* of a plane that the line runs along */
    *lo = wide_select(wide_select(beside, -infinite, nd > zero), t, nd < zero);
    *hi = wide_select(infinite, t, nd > zero);
    if ((line->left & MEMBER_KIND) == MEMBER_PLANE) {
        const wide_mask left = wide_is(load_wide_u32(block->plane), line->left >> MEMBER_SHIFT);
        const wide start = wide_all(line->start);
        *lo = wide_select(*lo, line->left_inside ? start : -infinite, left);
        *hi = wide_select(*hi, line->left_inside ? infinite : start, left);
    }
}

/* The slope of an end that a block has given. */
static inline real plane_slope(__global const LayoutPlane* plane, const Line* line, int left)
{
    return left ? R(0) : R(1) / fabs(dot3(load_vec(plane->n), line->d));
}

/* Outward normal; *p moves onto the surface. */
static inline vec plane_normal(__global const LayoutPlane* plane, vec* p)
{
    const vec n = load_vec(plane->n);
    *p = along(*p, n, (R(plane->h) - dot3(n, *p)) / dot3(n, n));
    return unit(n); /* stored to float, which is not unit enough for double */
}

#endif
