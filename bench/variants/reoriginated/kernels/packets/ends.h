/* The re-origined variant: where rays meet one primitive, the discriminant from the moment, all in plain arithmetic. */
#ifndef CLUCIDA_PACKETS_ENDS_H
#define CLUCIDA_PACKETS_ENDS_H

#include "kernels/packets/line.h"

INLINED wide_vec wide_cross(wide_vec a, wide_vec b)
{
    return make_wide_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* What has no roots ends nowhere. */
INLINED wide wide_root(wide discriminant)
{
    return where(discriminant > wide_all(R(0)), wide_sqrt(discriminant), wide_all(INFINITE));
}

#ifdef CLU_SPHERE
INLINED WideEnds wide_sphere_ends(__global const LayoutSphere* sphere, const WideLine* line, wide_mask chord)
{
    WideEnds e;
    const wide_vec o = wide_less(line->base, sphere->c), k = wide_cross(o, line->d);
    const wide dd = wide_dot(line->d, line->d), middle = -wide_dot(o, line->d) / dd;
    const wide half_chord = wide_root(square(R(sphere->r)) * dd - wide_dot(k, k)) / dd;
    (void)chord;
    e.lo = middle - half_chord;
    e.hi = middle + half_chord;
    return e;
}
#endif

#ifdef CLU_QUADRIC
INLINED WideEnds wide_quadric_ends(__global const LayoutQuadric* q, const WideLine* line, wide_mask* known)
{
    WideEnds e;
    const real s0 = R(q->s[0]), s1 = R(q->s[1]), s2 = R(q->s[2]), g = R(q->g);
    const wide_vec y = wide_apply(q->m, wide_less(line->base, q->c)), d = wide_apply(q->m, line->d);
    const wide_vec sd = make_wide_vec(s0 * d.x, s1 * d.y, s2 * d.z), k = wide_cross(y, d);
    const wide a = wide_dot(sd, d), dd = wide_dot(d, d), nearest = -wide_dot(y, d) / dd;
    const wide_vec x = wide_scaled(wide_cross(d, k), R(1) / dd);
    const wide b = wide_dot(sd, x) - g * d.z; /* half of the textbooks' b */
    const wide moment = s0 * s1 * k.z * k.z + s1 * s2 * k.x * k.x + s0 * s2 * k.y * k.y;
    const wide across = R(2) * g * (s0 * d.x * k.y - s1 * d.y * k.x);
    const wide root = wide_root(g * g * d.z * d.z + across - moment - R(q->w) * a);
    const wide one = nearest + (-b - root) / a, other = nearest + (-b + root) / a;
    (void)known;
    e.lo = wide_smaller(one, other);
    e.hi = wide_larger(one, other);
    return e;
}
#endif

#endif
