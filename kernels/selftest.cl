/* Does exact arithmetic survive this compiler? One work-item per pair of pairs a b, c d; the host knows the answers.
 * Results of an item: sum and error of a + b, product and error of a b, and a b - c d. */
#include "kernels/real.h"

__kernel void selftest(__global const float* restrict in, __global float* restrict out)
{
    const size_t item = get_global_id(0);
    const float a = in[4 * item], b = in[4 * item + 1], c = in[4 * item + 2], d = in[4 * item + 3];
    __global float* result = out + 5 * item;

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
