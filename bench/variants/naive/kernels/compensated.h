/* The naive variant: plain arithmetic under the names of the compensated. */
#ifndef CLUCIDA_COMPENSATED_H
#define CLUCIDA_COMPENSATED_H

#include "kernels/real.h"

static inline real difference_of_products(real a, real b, real c, real d)
{
    return a * b - c * d;
}

typedef struct {
    real sum, error;
} Sum;

static inline void sum_product(Sum* s, real a, real b)
{
    s->sum += a * b;
}

static inline real sum_value(Sum s)
{
    return s.sum;
}

#endif
