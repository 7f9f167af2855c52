/* Where a ray goes on from a surface: the mirror's direction, and Snell's. */
#ifndef CLUCIDA_DIRECTIONS_H
#define CLUCIDA_DIRECTIONS_H

#include "kernels/unit.h"

/* The mirror's direction at normal n on the side that d comes from, cosine = -d.n. What n lacks in length counts. */
INLINED vec reflected(vec d, vec n, real cosine)
{
    const real twice = R(2) * cosine;
    return renormalized(along(d, n, fma(-twice, length_excess(n), twice)));
}

/* Snell's law for a ray that comes from index n1 to n2; w = n1/n2, n the unit normal on the side that it comes from,
 * cosine = -d.n. det < 0 means total reflection. Written so that w = 1 changes nothing at all. */
INLINED real snell_det(real w, real cosine)
{
    const real wa = w * cosine;
    return fma(wa, wa, (R(1) - w) * (R(1) + w));
}

INLINED vec snell_refracted(vec d, vec n, real w, real cosine, real det)
{
    const real s = fma(w, cosine, sqrt(det));
    if (w == R(1) || s == R(0)) return d;
    return renormalized(along(scaled(d, w), n, (w - R(1)) * (w + R(1)) / s));
}

#endif
