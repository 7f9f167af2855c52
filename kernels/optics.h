/* What a surface does to light: refraction by the scene's law, Fresnel's weights, the laws of diffuse light. */
#ifndef CLUCIDA_OPTICS_H
#define CLUCIDA_OPTICS_H

#include "kernels/color.h"
#include "kernels/directions.h"
#include "kernels/functions.h"
#include "kernels/world.h"

#if defined(CLU_AS_GUN) || defined(CLU_AS_RAYT)
/* The original program's refraction, which is not Snell's: it takes the cosine from the direction that it has already
 * scaled by w (docs/original.md). */
#ifdef CLU_AS_GUN
#define LEAST_DET R(1e-5f)
#else
#define LEAST_DET R(1e-6f)
#endif
INLINED real refraction_det(real w, real cosine)
{
    const real a = w * cosine;
    const real det = R(1) - w * w * (R(1) - a * a);
    return det < LEAST_DET ? R(-1) : det;
}

INLINED vec refracted(vec d, vec n, real w, real cosine, real det)
{
    return unit(along(scaled(d, w), n, w * w * cosine - sqrt(det)));
}
#else
INLINED real refraction_det(real w, real cosine)
{
    return snell_det(w, cosine);
}

INLINED vec refracted(vec d, vec n, real w, real cosine, real det)
{
    return snell_refracted(d, n, w, cosine, det);
}
#endif

#ifdef CLU_FRESNEL
/* The reflected part of unpolarised light (Fresnel; Born and Wolf, Principles of Optics, 1.5.2). */
INLINED real fresnel_reflectance(real w, real cosine, real det)
{
    const real other = sqrt(det);
    if (w == R(1)) return R(0);
    const real s = (w * cosine - other) / (w * cosine + other);
    const real p = (w * other - cosine) / (w * other + cosine);
    const real r = R(0.5f) * (s * s + p * p);
    return r == r ? r : R(1);
}
#endif

#ifdef CLU_LIGHTS
/* How much of a light arrives at an angle of the given cosine > 0 over the given distance. */
INLINED real diffuse(u32 law, real cosine, real distance)
{
#ifdef CLU_LIGHT_INVERSE_SQUARE
    if (law == LAW_INVERSE_SQUARE) return cosine / (distance * distance);
#endif
#ifdef CLU_LIGHT_LAMBERT
    if (law == LAW_LAMBERT) return cosine;
#endif
    /* The paper's (2/pi) acos(1 - a), without its cancellation at the terminator. */
    if (cosine > R(0.5f)) return R(1) - R(2) / PI_REAL * arc_sine(R(1) - fmin(cosine, R(1)));
    return R(4) / PI_REAL * arc_sine(sqrt(R(0.5f) * cosine));
}
#endif

#endif
