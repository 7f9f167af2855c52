/* The angle of a point of the plane, for photographs. */
#ifndef CLUCIDA_ANGLE_H
#define CLUCIDA_ANGLE_H

#include "kernels/real.h"

/* As atan2, to some 2e-7 in float; PoCL's own takes ten times as long. Reduced to within tan(pi/8) of an axis or a
 * diagonal, there a polynomial (Moshier, Cephes, atanf). */
INLINED real angle_of(real y, real x)
{
#ifdef CLU_DOUBLE
    return atan2(y, x);
#else
    const real across = fabs(x), up = fabs(y), most = larger(across, up), least = smaller(across, up);
    const int diagonal = least > 0.414213562f * most;
    const real a = diagonal ? least - most : least, b = diagonal ? least + most : most;
    const real t = b > R(0) ? a / b : R(0), s = t * t;
    real angle = fma(
        fma(fma(fma(8.05374449538e-2f, s, -1.38776856032e-1f), s, 1.99777106478e-1f), s, -3.33329491539e-1f) * s, t, t);
    if (diagonal) angle += R(0.25f) * PI_REAL;
    if (up > across) angle = R(0.5f) * PI_REAL - angle;
    if (x < R(0)) angle = PI_REAL - angle;
    return copysign(angle, y);
#endif
}

#endif
