/* The naive variant: where rays meet one primitive, by the quadratic formula. */
#ifndef CLUCIDA_PACKETS_ENDS_H
#define CLUCIDA_PACKETS_ENDS_H

#include "kernels/packets/line.h"

/* Of a t^2 + b t + c; what has no roots ends nowhere. */
INLINED WideEnds wide_roots(wide a, wide b, wide c)
{
    WideEnds e;
    const wide discriminant = b * b - R(4) * a * c, over = R(0.5f) / a;
    const wide root = where(discriminant > wide_all(R(0)), wide_sqrt(discriminant), wide_all(INFINITE));
    const wide one = (-b - root) * over, other = (-b + root) * over;
    e.lo = wide_smaller(one, other);
    e.hi = wide_larger(one, other);
    return e;
}

#ifdef CLU_SPHERE
INLINED WideEnds wide_sphere_ends(__global const LayoutSphere* sphere, const WideLine* line, wide_mask chord)
{
    const wide_vec o = wide_less(line->base, sphere->c);
    (void)chord;
    return wide_roots(wide_dot(line->d, line->d), R(2) * wide_dot(o, line->d),
                      wide_dot(o, o) - wide_all(square(R(sphere->r))));
}
#endif

#ifdef CLU_QUADRIC
INLINED WideEnds wide_quadric_ends(__global const LayoutQuadric* q, const WideLine* line, wide_mask* known)
{
    const wide_vec o = wide_apply(q->m, wide_less(line->base, q->c)), d = wide_apply(q->m, line->d);
    const wide_vec sd = make_wide_vec(R(q->s[0]) * d.x, R(q->s[1]) * d.y, R(q->s[2]) * d.z);
    const wide_vec so = make_wide_vec(R(q->s[0]) * o.x, R(q->s[1]) * o.y, R(q->s[2]) * o.z);
    const real g = R(q->g);
    (void)known;
    return wide_roots(wide_dot(sd, d), R(2) * (wide_dot(sd, o) - g * d.z),
                      wide_dot(so, o) - R(2) * g * o.z + wide_all(R(q->w)));
}
#endif

#endif
