/* Colours: linear light in three channels, and filters packed into 32 bits. */
#ifndef CLUCIDA_COLOR_H
#define CLUCIDA_COLOR_H

#include "kernels/layout.h"
#include "kernels/real.h"

typedef struct {
    real r, g, b;
} rgb;

INLINED rgb make_rgb(real r, real g, real b)
{
    rgb c;
    c.r = r;
    c.g = g;
    c.b = b;
    return c;
}

INLINED rgb grey(real v)
{
    return make_rgb(v, v, v);
}
INLINED rgb load_rgb(__global const float* p)
{
    return make_rgb(R(p[0]), R(p[1]), R(p[2]));
}
INLINED rgb rgb_add(rgb a, rgb b)
{
    return make_rgb(a.r + b.r, a.g + b.g, a.b + b.b);
}
INLINED rgb rgb_filter(rgb a, rgb b)
{
    return make_rgb(a.r * b.r, a.g * b.g, a.b * b.b);
}
INLINED rgb rgb_scale(rgb a, real s)
{
    return make_rgb(a.r * s, a.g * s, a.b * s);
}
INLINED rgb rgb_mix(rgb a, rgb b, real s)
{
    return rgb_add(rgb_scale(a, R(1) - s), rgb_scale(b, s));
}
INLINED rgb rgb_saturate(rgb a)
{
    return make_rgb(fmin(a.r, R(1)), fmin(a.g, R(1)), fmin(a.b, R(1)));
}
INLINED real rgb_largest(rgb a)
{
    return larger(a.r, larger(a.g, a.b));
}

/* A filter: square roots of r, g, b at 11, 11 and 10 bits, so that 0 and 1 are exact and the error is even to the eye
 * (docs/numerics.md has the comparison with other 32-bit formats). */
INLINED rgb unpack_filter(u32 packed)
{
    return make_rgb(square(R(packed & 2047u) / R(2047)), square(R(packed >> 11 & 2047u) / R(2047)),
                    square(R(packed >> 22) / R(1023)));
}

#endif
