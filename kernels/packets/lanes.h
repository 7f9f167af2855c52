/* What a packet of eight rays is computed with: a number, a vector or a truth of each, side by side. */
#ifndef CLUCIDA_PACKETS_LANES_H
#define CLUCIDA_PACKETS_LANES_H

#include "kernels/wide.h"
#include "kernels/world.h"

/* a where the mask is set, else b. */
INLINED wide where(wide_mask mask, wide a, wide b)
{
    return wide_select(b, a, mask);
}
INLINED wide_id where_id(wide_mask mask, wide_id a, wide_id b)
{
    return id_select(b, a, mask);
}

typedef struct {
    wide x, y, z;
} wide_vec;

INLINED wide_vec make_wide_vec(wide x, wide y, wide z)
{
    wide_vec v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
INLINED wide wide_dot(wide_vec a, wide_vec b)
{
    return wide_fma(a.x, b.x, wide_fma(a.y, b.y, a.z * b.z));
}
/* o + t d */
INLINED wide_vec wide_along(wide_vec o, wide_vec d, wide t)
{
    return make_wide_vec(wide_fma(d.x, t, o.x), wide_fma(d.y, t, o.y), wide_fma(d.z, t, o.z));
}
INLINED wide_vec wide_scaled(wide_vec a, wide s)
{
    return make_wide_vec(a.x * s, a.y * s, a.z * s);
}
/* a less a point that all lanes share. */
INLINED wide_vec wide_less(wide_vec a, __global const float* b)
{
    return make_wide_vec(a.x - wide_all(R(b[0])), a.y - wide_all(R(b[1])), a.z - wide_all(R(b[2])));
}
/* The scalar product with a vector that all lanes share. */
INLINED wide wide_dot_shared(__global const float* a, wide_vec b)
{
    return wide_fma(wide_all(R(a[0])), b.x, wide_fma(wide_all(R(a[1])), b.y, wide_all(R(a[2])) * b.z));
}
/* The product of a row-major 3x3 matrix, the same in all lanes, and vectors. */
INLINED wide_vec wide_apply(__global const float* m, wide_vec v)
{
    return make_wide_vec(wide_dot_shared(m, v), wide_dot_shared(m + 3, v), wide_dot_shared(m + 6, v));
}
INLINED wide wide_max_norm(wide_vec a)
{
    return wide_larger(wide_fabs(a.x), wide_larger(wide_fabs(a.y), wide_fabs(a.z)));
}

/* As Sum, length_excess, renormalized and unit (kernels/unit.h), with the same roundings. */
typedef struct {
    wide value, error;
} WideSum;

INLINED void wide_add_square(WideSum* s, wide a)
{
    const wide p = a * a, t = s->value + p, z = t - s->value;
    s->error += wide_fma(a, a, -p);
    s->error += (s->value - (t - z)) + (p - z);
    s->value = t;
}
INLINED wide wide_length_excess(wide_vec d)
{
    WideSum s;
    s.value = wide_all(R(-1));
    s.error = wide_all(R(0));
    wide_add_square(&s, d.x);
    wide_add_square(&s, d.y);
    wide_add_square(&s, d.z);
    return s.value + s.error;
}
INLINED wide_vec wide_renormalized(wide_vec d)
{
    return wide_along(d, d, R(-0.5f) * wide_length_excess(d));
}
INLINED wide_vec wide_unit(wide_vec a)
{
    return wide_renormalized(wide_scaled(a, R(1) / wide_sqrt(wide_dot(a, a))));
}

#endif
