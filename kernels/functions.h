/* Functions that implementations round each in their own way, of sums and products that all of them round alike, so
 * that a picture is the same on every device. In double the built-in ones. The polynomials are least in their largest
 * relative error, found by Lawson's iteration. */
#ifndef CLUCIDA_FUNCTIONS_H
#define CLUCIDA_FUNCTIONS_H

#include "kernels/real.h"

/* What exp(-x) = 2^n e^r is made of, |r| <= ln 2 / 2: ROUNDER makes a float's last bits the whole number n. */
#define ROUNDER 12582912.0f
#define LOG2_E 1.4426950216293335f
#define LN2_HIGH 0.693145751953125f
#define LN2_LOW 1.428606765330187e-6f
#define MOST_DECAY 87.0f

/* e^r, |r| <= ln 2 / 2, to 3e-9 before rounding; 1 exactly for 0. Of a scalar or of lanes. */
#define EXP_POLYNOMIAL(fma, all, r)                                                                                    \
    (fma((r) * (r),                                                                                                    \
         fma(fma(fma(fma(all(1.3951719738543034e-3f), r, all(8.369598537683487e-3f)), r, all(4.16661873459816e-2f)),   \
                 r, all(0.16666512191295624f)),                                                                        \
             r, all(0.5f)),                                                                                            \
         r) +                                                                                                          \
     all(1.0f))

/* exp(-x) for x >= 0, to 1.1 units of the last place; 0 where that is less than 1.7e-38. */
INLINED real decay(real x)
{
#ifdef CLU_DOUBLE
    return exp(-x);
#else
    const float shifted = fma(x, -LOG2_E, ROUNDER), n = shifted - ROUNDER;
    const float r = fma(n, -LN2_LOW, fma(n, -LN2_HIGH, -x));
    const float scale = as_float((as_uint(shifted) << 23) + 0x3f800000u);
    return x > MOST_DECAY ? 0.0f : EXP_POLYNOMIAL(fma, R, r) * scale;
#endif
}

/* asin(x) for 0 <= x <= 1/2, to 0.7 units of the last place. */
INLINED real arc_sine(real x)
{
#ifdef CLU_DOUBLE
    return asin(x);
#else
    const float z = x * x;
    const float p = fma(fma(fma(fma(4.2218565940856934e-2f, z, 2.4147601798176765e-2f), z, 4.547709971666336e-2f), z,
                            7.495241612195969e-2f),
                        z, 0.16666753590106964f);
    return fma(x * z, p, x);
#endif
}

/* The cube root of x >= 0, to 1e-6: for estimates. The exponent's third, and three of Newton's steps. */
INLINED real cube_root(real x)
{
    real y = R(as_float(as_uint((float)x) / 3u + 709921077u));
    y = (y + y + x / (y * y)) / R(3);
    y = (y + y + x / (y * y)) / R(3);
    return (y + y + x / (y * y)) / R(3);
}

#endif
