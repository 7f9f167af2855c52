/* The self-test: one work-item for each pair of pairs. */
#include "kernels/selftest.h"

__kernel void selftest(__global const float* restrict in, __global float* restrict out)
{
    const size_t item = get_global_id(0);
    test_arithmetic(in + 4 * item, out + 5 * item);
}
