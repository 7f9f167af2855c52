/* The naive and the re-origined variant: rays in an object's coordinates. Where they start, approach.h says. */
#ifndef CLUCIDA_PACKETS_LINE_H
#define CLUCIDA_PACKETS_LINE_H

#include "kernels/packets/exact.h"
#include "kernels/packets/spans.h"
#include "kernels/rounding.h"

typedef struct {
    wide_vec base, origin, d;
    wide start;
} WideLine;

typedef struct {
    wide lo, hi;
} WideEnds;

#include "kernels/packets/approach.h"

INLINED WideLine wide_line(wide_vec o, wide_vec d, wide excess, __global const LayoutObject* object)
{
    WideLine l;
    (void)excess;
    l.d = d;
    l.origin = l.base = wide_less(o, object->center);
    l.start = wide_all(R(0));
    wide_approach(&l, object);
    return l;
}

INLINED wide wide_surface_error(const WideLine* line, wide at, wide_vec p)
{
    (void)line;
    (void)at;
    (void)p;
    return wide_all(EPSILON);
}

#ifdef CLU_PLANE
INLINED WideEnds wide_plane_ends(__global const LayoutPlane* plane, const WideLine* line)
{
    WideEnds e;
    e.lo = e.hi = (wide_all(R(plane->h)) - wide_dot_shared(plane->n, line->base)) / wide_dot_shared(plane->n, line->d);
    return e;
}

INLINED wide_vec wide_plane_normal(__global const LayoutPlane* plane, wide_vec* p)
{
    (void)p;
    return make_wide_vec(wide_all(R(plane->n[0])), wide_all(R(plane->n[1])), wide_all(R(plane->n[2])));
}
#endif

#ifdef CLU_SPHERE
INLINED wide_vec wide_sphere_normal(__global const LayoutSphere* sphere, wide_vec* p)
{
    return wide_unit(wide_less(*p, sphere->c));
}
#endif

#ifdef CLU_QUADRIC
INLINED wide_vec wide_quadric_normal(__global const LayoutQuadric* q, wide_vec* p)
{
    const wide_vec x = wide_apply(q->m, wide_less(*p, q->c));
    return wide_unit(wide_apply_transposed(q->m, packet_gradient(q, x)));
}
#endif

#endif
