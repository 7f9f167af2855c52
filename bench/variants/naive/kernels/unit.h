/* The naive variant: a unit vector is a vector over its length, and taken to stay one. */
#ifndef CLUCIDA_UNIT_H
#define CLUCIDA_UNIT_H

#include "kernels/vec.h"

static inline vec normalized(vec a)
{
    return scaled(a, R(1) / sqrt(dot3(a, a)));
}

/* Its length is 1. */
static inline real length_excess(vec d)
{
    (void)d;
    return R(0);
}
static inline real over_square(real x, real excess)
{
    (void)excess;
    return x;
}

static inline vec renormalized(vec d)
{
    return d;
}

static inline vec unit(vec a)
{
    return normalized(a);
}

#endif
