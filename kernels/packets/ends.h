/* Where a packet's rays meet one primitive, by the robust arithmetic of kernels/solids: all of them at once, with the
 * same roundings, so that every lane's end and normal are to the bit what one ray's would be. */
#ifndef CLUCIDA_PACKETS_ENDS_H
#define CLUCIDA_PACKETS_ENDS_H

#include "kernels/packets/exact.h"
#include "kernels/packets/spans.h"
#include "kernels/solids/quadric.h"

/* As Line (kernels/line.h). */
typedef struct {
    wide_vec base, origin, d;
    wide start, excess, size;
} WideLine;

typedef struct {
    wide lo, hi;
} WideEnds;

INLINED WideLine wide_line(wide_vec o, wide_vec d, wide excess, __global const LayoutObject* object)
{
    WideLine l;
    l.d = d;
    l.excess = excess;
    l.origin = l.base = wide_less(o, object->center);
    l.start = wide_all(R(0));
    const wide_mask far = wide_dot(l.origin, l.origin) > wide_all(square(R(object->near)));
    if (any_lane(far)) {
        const wide start = wide_over_square(wide_dot(l.origin, d), excess);
        const wide_vec p = wide_along(l.origin, d, -start);
        l.start = where(far, start, l.start);
        l.base.x = where(far, p.x + wide_difference_error(o.x, wide_all(R(object->center[0]))), l.base.x);
        l.base.y = where(far, p.y + wide_difference_error(o.y, wide_all(R(object->center[1]))), l.base.y);
        l.base.z = where(far, p.z + wide_difference_error(o.z, wide_all(R(object->center[2]))), l.base.z);
    }
    l.size = wide_larger(wide_max_norm(l.base), wide_all(R(object->grain)));
    return l;
}

/* As surface_error (kernels/rounding.h) of the point p, at parameter `at`. */
INLINED wide wide_surface_error(const WideLine* line, wide at, wide_vec p)
{
    const wide stored =
        R(STORED_ROUNDOFF / UNIT_ROUNDOFF) * (ROUNDINGS * UNIT_ROUNDOFF * wide_larger(line->size, wide_fabs(at)));
    return wide_larger(ROUNDINGS * R(STORED_ROUNDOFF) * wide_larger(wide_max_norm(p), wide_all(R(0))), stored);
}

#ifdef CLU_PLANE
INLINED WideEnds wide_plane_ends(__global const LayoutPlane* plane, const WideLine* line)
{
    WideEnds e;
    const wide nd = wide_dot_shared(plane->n, line->d);
    const wide height = wide_dot_shared(plane->n, line->base) - wide_all(R(plane->h));
    const wide reciprocal = wide_all(R(1)) / nd, quotient = -height * reciprocal;
    e.lo = e.hi = wide_fma(-wide_fma(quotient, nd, height), reciprocal, quotient);
    return e;
}

INLINED wide_vec wide_plane_normal(__global const LayoutPlane* plane, wide_vec* p)
{
    const vec n = load_vec(plane->n), u = unit(n);
    const wide t = (wide_all(R(plane->h)) - wide_dot_shared(plane->n, *p)) / wide_all(dot3(n, n));
    *p = wide_along(*p, make_wide_vec(wide_all(n.x), wide_all(n.y), wide_all(n.z)), t);
    return make_wide_vec(wide_all(u.x), wide_all(u.y), wide_all(u.z));
}
#endif

#ifdef CLU_SPHERE
/* chord: the rays that have left the sphere to its inside. */
INLINED WideEnds wide_sphere_ends(__global const LayoutSphere* sphere, const WideLine* line, wide_mask chord)
{
    WideEnds e;
    const wide r = wide_all(R(sphere->r)), zero = wide_all(R(0));
    const wide_vec o = wide_less(line->base, sphere->c), k = wide_cross_exact(o, line->d);
    const wide discriminant = wide_fma(r * r, line->excess, wide_fma(r, r, -wide_dot(k, k)));
    const wide_mask met = discriminant > zero;
    const wide root = wide_sqrt(where(met, discriminant, zero));
    const wide t = wide_over_square(-wide_dot(o, line->d), line->excess);
    const wide half_chord = wide_over_square(root, line->excess);
    e.lo = where(met, t - half_chord, wide_all(INFINITE));
    e.hi = where(met, t + half_chord, wide_all(-INFINITE));
    if (any_lane(chord)) {
        const wide length = R(-2) * wide_dot_exact(wide_less(line->origin, sphere->c), line->d);
        const wide end = line->start + wide_over_square(length, line->excess);
        const wide least = wide_fma(wide_all(R(4) * UNIT_ROUNDOFF), wide_fabs(line->start), wide_all(R(1e-30f)));
        e.lo = where(chord, line->start, e.lo);
        e.hi = where(chord, wide_larger(end, line->start + least), e.hi);
    }
    return e;
}

INLINED wide_vec wide_sphere_normal(__global const LayoutSphere* sphere, wide_vec* p)
{
    const wide_vec n = wide_unit(wide_less(*p, sphere->c));
    *p = make_wide_vec(wide_fma(n.x, wide_all(R(sphere->r)), wide_all(R(sphere->c[0]))),
                       wide_fma(n.y, wide_all(R(sphere->r)), wide_all(R(sphere->c[1]))),
                       wide_fma(n.z, wide_all(R(sphere->r)), wide_all(R(sphere->c[2]))));
    return n;
}
#endif

#ifdef CLU_QUADRIC
INLINED wide wide_quadric_discriminant(__global const LayoutQuadric* q, wide_vec x, wide_vec d, wide a)
{
    const real s0 = R(q->s[0]), s1 = R(q->s[1]), s2 = R(q->s[2]), g = R(q->g);
    const wide_vec k = wide_cross_exact(x, d);
    const wide z = s0 * s1 * k.z;
    if (g != R(0)) {
        const wide up = g * d.z, across = s0 * d.x * k.y - s1 * d.y * k.x;
        return wide_fma(up, up, wide_fma(wide_all(R(2) * g), across, -z * k.z));
    }
    const wide last = wide_fma(-s0 * s2 * k.y, k.y, R(-q->w) * a);
    return wide_fma(-z, k.z, wide_fma(-s1 * s2 * k.x, k.x, last));
}

/* Of rays that have not just left the quadric; near an asymptote one ray's arithmetic is needed. */
INLINED WideEnds wide_quadric_ends(__global const LayoutQuadric* q, const WideLine* line, wide_mask* known)
{
    WideEnds e;
    const real g = R(q->g), sx = R(q->s[0]), sy = R(q->s[1]), sz = R(q->s[2]);
    const wide zero = wide_all(R(0));
    const wide_vec x = wide_apply(q->m, wide_less(line->base, q->c)), d = wide_apply(q->m, line->d);
    const wide_vec part = make_wide_vec(sx * d.x, sy * d.y, sz * d.z);
    const wide a = wide_dot(part, d), b = wide_fma(wide_all(-g), d.z, wide_dot(part, x));
    if (!quadric_is_convex(q)) *known &= ~(wide_fabs(a) < NEAR_ASYMPTOTE * wide_dot(d, d));
    const wide slanted = wide_fma(wide_all(sz), x.z, wide_all(R(-2) * g));
    const wide c = wide_fma(sx * x.x, x.x, wide_fma(sy * x.y, x.y, wide_fma(slanted, x.z, wide_all(R(q->w)))));
    wide discriminant = wide_quadric_discriminant(q, x, d, a);
    discriminant = where(a * c < zero, wide_larger(b * b, discriminant), discriminant);
    *known &= (discriminant > zero) & (a != zero);
    const wide root = wide_sqrt(where(*known, discriminant, wide_all(R(1))));
    const wide s = -(b + wide_copysign(root, b)), one = c / s, other = s / a;
    e.lo = wide_smaller(one, other);
    e.hi = wide_larger(one, other);
    return e;
}

INLINED wide wide_quadric_value(__global const LayoutQuadric* q, wide_vec x)
{
    WideSum s = make_wide_sum(R(q->w));
    wide_sum_product(&s, R(q->s[0]) * x.x, x.x);
    wide_sum_product(&s, R(q->s[1]) * x.y, x.y);
    wide_sum_product(&s, wide_fma(wide_all(R(q->s[2])), x.z, wide_all(R(-2) * R(q->g))), x.z);
    return s.value + s.error;
}

INLINED wide_vec wide_quadric_normal(__global const LayoutQuadric* q, wide_vec* p)
{
    const wide_vec x = wide_apply(q->m, wide_less(*p, q->c));
    const wide_vec g = wide_apply_transposed(q->m, packet_gradient(q, x));
    const wide gg = wide_dot(g, g), zero = wide_all(R(0)), one = wide_all(R(1));
    const wide_mask regular = gg > zero;
    const wide_vec moved = wide_along(*p, g, R(-0.5f) * wide_quadric_value(q, x) / gg);
    const wide_vec n = wide_renormalized(wide_scaled(g, one / wide_sqrt(gg)));
    *p = make_wide_vec(where(regular, moved.x, p->x), where(regular, moved.y, p->y), where(regular, moved.z, p->z));
    return make_wide_vec(where(regular, n.x, zero), where(regular, n.y, zero), where(regular, n.z, one));
}
#endif

#endif
