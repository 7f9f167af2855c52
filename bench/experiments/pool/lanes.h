/* A number of each ray of a packet, side by side. A lane of a mask is all ones or 0. */
#ifndef POOL_LANES_H
#define POOL_LANES_H

#include "kernels/world.h"

#define POOL_JOINED(a, b) a##b
#define POOL_JOIN(a, b) POOL_JOINED(a, b)
typedef POOL_JOIN(float, POOL_WIDTH) vreal;
typedef POOL_JOIN(int, POOL_WIDTH) vint;
typedef POOL_JOIN(uint, POOL_WIDTH) vword;
#define LOAD POOL_JOIN(vload, POOL_WIDTH)
#define STORE POOL_JOIN(vstore, POOL_WIDTH)
#define AS_REALS POOL_JOIN(as_float, POOL_WIDTH)
#define AS_INTS POOL_JOIN(as_int, POOL_WIDTH)
#define AS_WORDS POOL_JOIN(as_uint, POOL_WIDTH)
#define TO_REALS POOL_JOIN(convert_float, POOL_WIDTH)
#define ALL(x) ((vreal)(x))
#define FAR ALL(INFINITY)

/* a where the mask is set, else b. */
#define CHOOSE(mask, a, b) select(b, a, mask)

/* Whether a mask has any lane set. any() asks for each lane's sign, which costs more. */
INLINED int any_lane(vint mask)
{
#if POOL_WIDTH == 8
    const long4 four = as_long4(mask);
#else
    const long8 eight = as_long8(mask);
    const long4 four = eight.lo | eight.hi;
#endif
    const long2 two = four.lo | four.hi;
    return (two.x | two.y) != 0;
}

typedef struct {
    vreal x, y, z;
} vvec;

INLINED vreal vdot(vvec a, vvec b)
{
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
INLINED vvec valong(vvec o, vvec d, vreal t)
{
    vvec p;
    p.x = fma(d.x, t, o.x);
    p.y = fma(d.y, t, o.y);
    p.z = fma(d.z, t, o.z);
    return p;
}
INLINED vvec vscaled(vvec a, vreal s)
{
    a.x *= s;
    a.y *= s;
    a.z *= s;
    return a;
}
/* a less a point that all lanes share. */
INLINED vvec vless(vvec a, __global const float* b)
{
    a.x -= b[0];
    a.y -= b[1];
    a.z -= b[2];
    return a;
}
/* The product of a row-major 3x3 matrix, the same in all lanes, and vectors. */
INLINED vvec vapply(__global const float* m, vvec v)
{
    vvec r;
    r.x = fma(m[0], v.x, fma(m[1], v.y, m[2] * v.z));
    r.y = fma(m[3], v.x, fma(m[4], v.y, m[5] * v.z));
    r.z = fma(m[6], v.x, fma(m[7], v.y, m[8] * v.z));
    return r;
}

/* As Sum, length_excess, renormalized and unit (kernels/unit.h), with the same roundings. */
typedef struct {
    vreal value, error;
} VSum;

INLINED void vsum_product(VSum* s, vreal a)
{
    const vreal p = a * a, t = s->value + p, z = t - s->value;
    s->error += fma(a, a, -p);
    s->error += (s->value - (t - z)) + (p - z);
    s->value = t;
}
INLINED vreal vexcess(vvec d)
{
    VSum s = {ALL(-1.0f), ALL(0.0f)};
    vsum_product(&s, d.x);
    vsum_product(&s, d.y);
    vsum_product(&s, d.z);
    return s.value + s.error;
}
INLINED vvec vrenormalized(vvec d)
{
    return valong(d, d, -0.5f * vexcess(d));
}
INLINED vvec vunit(vvec a)
{
    return vrenormalized(vscaled(a, 1.0f / sqrt(vdot(a, a))));
}

#endif
