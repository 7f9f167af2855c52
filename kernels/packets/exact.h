/* Arithmetic that keeps what rounding would lose, as kernels/compensated.h, vec.h and unit.h have it of one lane, with
 * the same roundings. */
#ifndef CLUCIDA_PACKETS_EXACT_H
#define CLUCIDA_PACKETS_EXACT_H

#include "kernels/packets/lanes.h"

INLINED wide wide_difference_of_products(wide a, wide b, wide c, wide d)
{
    const wide w = c * d, e = wide_fma(-c, d, w);
    return wide_fma(a, b, -w) + e;
}
INLINED wide wide_difference_error(wide a, wide b)
{
    const wide d = a - b, z = d - a;
    return (a - (d - z)) - (b + z);
}
INLINED wide_vec wide_cross_exact(wide_vec a, wide_vec b)
{
    return make_wide_vec(wide_difference_of_products(a.y, b.z, a.z, b.y),
                         wide_difference_of_products(a.z, b.x, a.x, b.z),
                         wide_difference_of_products(a.x, b.y, a.y, b.x));
}

typedef struct {
    wide value, error;
} WideSum;

INLINED WideSum make_wide_sum(real value)
{
    WideSum s;
    s.value = wide_all(value);
    s.error = wide_all(R(0));
    return s;
}
INLINED void wide_sum_product(WideSum* s, wide a, wide b)
{
    const wide p = a * b, t = s->value + p, z = t - s->value;
    s->error += wide_fma(a, b, -p);
    s->error += (s->value - (t - z)) + (p - z);
    s->value = t;
}
INLINED wide wide_dot_exact(wide_vec a, wide_vec b)
{
    WideSum s = make_wide_sum(R(0));
    wide_sum_product(&s, a.x, b.x);
    wide_sum_product(&s, a.y, b.y);
    wide_sum_product(&s, a.z, b.z);
    return s.value + s.error;
}
INLINED wide wide_length_excess(wide_vec d)
{
    WideSum s = make_wide_sum(R(-1));
    wide_sum_product(&s, d.x, d.x);
    wide_sum_product(&s, d.y, d.y);
    wide_sum_product(&s, d.z, d.z);
    return s.value + s.error;
}
INLINED wide wide_over_square(wide x, wide excess)
{
    return wide_fma(-excess, x, x);
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
