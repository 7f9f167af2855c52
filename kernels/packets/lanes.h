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

/* A set of rays as a mask. */
INLINED wide_mask rays_mask(u32 rays)
{
    wide_id bit;
    const int bits[LANES] = {1, 2, 4, 8, 16, 32, 64, 128};
    bit = load_ids(bits);
    return (all_ids((int)rays) & bit) == bit;
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
INLINED wide_vec wide_apply_transposed(__global const float* m, wide_vec v)
{
    const wide x0 = wide_all(R(m[0])), x1 = wide_all(R(m[1])), x2 = wide_all(R(m[2]));
    const wide y0 = wide_all(R(m[3])), y1 = wide_all(R(m[4])), y2 = wide_all(R(m[5]));
    const wide z0 = wide_all(R(m[6])), z1 = wide_all(R(m[7])), z2 = wide_all(R(m[8]));
    return make_wide_vec(wide_fma(x0, v.x, wide_fma(y0, v.y, z0 * v.z)), wide_fma(x1, v.x, wide_fma(y1, v.y, z1 * v.z)),
                         wide_fma(x2, v.x, wide_fma(y2, v.y, z2 * v.z)));
}
INLINED wide wide_max_norm(wide_vec a)
{
    return wide_larger(wide_fabs(a.x), wide_larger(wide_fabs(a.y), wide_fabs(a.z)));
}

#endif
