/* Vectors of three reals. */
#ifndef CLUCIDA_VEC_H
#define CLUCIDA_VEC_H

#include "kernels/compensated.h"

typedef struct {
    real x, y, z;
} vec;

INLINED vec make_vec(real x, real y, real z)
{
    vec v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

INLINED vec load_vec(__global const float* p)
{
    return make_vec(R(p[0]), R(p[1]), R(p[2]));
}
INLINED vec add(vec a, vec b)
{
    return make_vec(a.x + b.x, a.y + b.y, a.z + b.z);
}
INLINED vec sub(vec a, vec b)
{
    return make_vec(a.x - b.x, a.y - b.y, a.z - b.z);
}
INLINED vec scaled(vec a, real s)
{
    return make_vec(a.x * s, a.y * s, a.z * s);
}
INLINED real dot3(vec a, vec b)
{
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
INLINED real dot_exact(vec a, vec b)
{
    Sum s = {R(0), R(0)};
    sum_product(&s, a.x, b.x);
    sum_product(&s, a.y, b.y);
    sum_product(&s, a.z, b.z);
    return sum_value(s);
}
INLINED vec along(vec o, vec d, real t)
{
    return make_vec(fma(d.x, t, o.x), fma(d.y, t, o.y), fma(d.z, t, o.z));
}
INLINED real largest(vec a)
{
    return larger(fabs(a.x), larger(fabs(a.y), fabs(a.z)));
}

/* a x b, each component to within 1.5 ulp. */
INLINED vec cross_exact(vec a, vec b)
{
    return make_vec(difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
                    difference_of_products(a.x, b.y, a.y, b.x));
}

/* The product of a row-major 3x3 matrix, or of its transpose, and a vector. */
INLINED vec apply(__global const float* m, vec v)
{
    return make_vec(fma(R(m[0]), v.x, fma(R(m[1]), v.y, R(m[2]) * v.z)),
                    fma(R(m[3]), v.x, fma(R(m[4]), v.y, R(m[5]) * v.z)),
                    fma(R(m[6]), v.x, fma(R(m[7]), v.y, R(m[8]) * v.z)));
}

INLINED vec apply_transposed(__global const float* m, vec v)
{
    return make_vec(fma(R(m[0]), v.x, fma(R(m[3]), v.y, R(m[6]) * v.z)),
                    fma(R(m[1]), v.x, fma(R(m[4]), v.y, R(m[7]) * v.z)),
                    fma(R(m[2]), v.x, fma(R(m[5]), v.y, R(m[8]) * v.z)));
}

#endif
