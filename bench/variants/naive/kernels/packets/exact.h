/* The naive variant: plain arithmetic under the names of the compensated, eight lanes at once. */
#ifndef CLUCIDA_PACKETS_EXACT_H
#define CLUCIDA_PACKETS_EXACT_H

#include "kernels/packets/lanes.h"

INLINED wide wide_length_excess(wide_vec d)
{
    (void)d;
    return wide_all(R(0));
}
INLINED wide_vec wide_renormalized(wide_vec d)
{
    return d;
}
INLINED wide_vec wide_unit(wide_vec a)
{
    return wide_scaled(a, R(1) / wide_sqrt(wide_dot(a, a)));
}

#endif
