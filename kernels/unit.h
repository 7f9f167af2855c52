/* Unit vectors, and how they are kept so. */
#ifndef CLUCIDA_UNIT_H
#define CLUCIDA_UNIT_H

#include "kernels/vec.h"

INLINED vec normalized(vec a)
{
    return scaled(a, R(1) / sqrt(dot3(a, a)));
}

/* |d|^2 - 1 of a vector that is nearly unit, without cancellation. Rounding |d|^2 itself would not do: floats lie half
 * as dense above 1 as below, so it comes out too small on average, which 1000 chords of a sphere add up. */
INLINED real length_excess(vec d)
{
    Sum s = {R(-1), R(0)};
    sum_product(&s, d.x, d.x);
    sum_product(&s, d.y, d.y);
    sum_product(&s, d.z, d.z);
    return sum_value(s);
}

/* x / |d|^2, where |d|^2 exceeds 1 by no more than rounding makes of it: sharper than division by the rounded square.
 */
INLINED real over_square(real x, real excess)
{
    return fma(-excess, x, x);
}

/* A direction that is nearly unit, one Newton step nearer. */
INLINED vec renormalized(vec d)
{
    return along(d, d, R(-0.5f) * length_excess(d));
}

/* The direction of a vector of any length, to the last bits. */
INLINED vec unit(vec a)
{
    return renormalized(normalized(a));
}

#endif
