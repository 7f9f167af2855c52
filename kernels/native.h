/* The shim that lets the kernels' C compile as C11: for unit tests, sanitizers and the native build.
 * Build with -ffp-contract=off, as OpenCL builds do by pragma. */
#ifndef CLUCIDA_NATIVE_H
#define CLUCIDA_NATIVE_H
#ifndef __OPENCL_VERSION__

#include "kernels/layout.h"
#include <string.h>
#ifdef __cplusplus
#include <math.h>
#else
#include <tgmath.h>
#endif

#define __global
#define __kernel
#define __private

static inline float as_float(u32 bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}
static inline u32 as_uint(float value)
{
    u32 bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

#endif
#endif
