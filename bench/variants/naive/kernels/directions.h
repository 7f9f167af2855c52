/* The naive variant: the mirror's direction and Snell's by the formulas of textbooks. */
#ifndef CLUCIDA_DIRECTIONS_H
#define CLUCIDA_DIRECTIONS_H

#include "kernels/unit.h"

static inline vec reflected(vec d, vec n, real cosine)
{
    return normalized(along(d, n, R(2) * cosine));
}

static inline real snell_det(real w, real cosine)
{
    return R(1) - w * w * (R(1) - cosine * cosine);
}

static inline vec snell_refracted(vec d, vec n, real w, real cosine, real det)
{
    return normalized(along(scaled(d, w), n, w * cosine - sqrt(det)));
}

#endif
