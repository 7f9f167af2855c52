/* Does exact arithmetic survive this compiler? Of pairs a b, c d; the host knows the answers. */
#ifndef CLUCIDA_SELFTEST_H
#define CLUCIDA_SELFTEST_H

#include "kernels/real.h"

/* Sum and error of a + b, product and error of a b, and a b - c d. */
INLINED void test_arithmetic(__global const float* in, __global float* result)
{
    const float a = in[0], b = in[1], c = in[2], d = in[3];

    const float sum = a + b;
    const float z = sum - a;
    result[0] = sum;
    result[1] = (a - (sum - z)) + (b - z);

    const float product = a * b;
    result[2] = product;
    result[3] = fma(a, b, -product);

    const float w = c * d;
    const float e = fma(-c, d, w);
    result[4] = fma(a, b, -w) + e;
}

#endif
