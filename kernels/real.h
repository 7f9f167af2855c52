/* The floating-point type. */
#ifndef CLUCIDA_REAL_H
#define CLUCIDA_REAL_H

#ifdef __OPENCL_VERSION__
#pragma OPENCL FP_CONTRACT OFF
#ifdef CLU_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#elif defined(CLU_NO_FMA)
#include "kernels/fused.h"
#endif
#ifndef fma8
#define fma8 fma
#endif
#else
#include "kernels/native.h"
#endif

/* INLINED: small and on every ray's way. CALLED: so large that a copy of it at each of its calls is not worth what it
 * costs to compile. What compiles SPIR further decides for itself, and Oclgrind 21.10 fails on what inlining leaves
 * (docs/portability.md). */
#ifdef __SPIR__
#define INLINED static inline
#else
#define INLINED static inline __attribute__((always_inline))
#endif
#define CALLED __attribute__((noinline))

/* What a scene's coordinates are stored to, whatever the arithmetic. */
#define STORED_ROUNDOFF 5.9604644775390625e-8f
#ifdef CLU_DOUBLE
typedef double real;
#define UNIT_ROUNDOFF 1.1102230246251565e-16
#define PI_REAL 3.14159265358979323846
#else
typedef float real;
#define UNIT_ROUNDOFF 5.9604644775390625e-8f
#define PI_REAL 3.14159265358979323846f
#endif

/* A constant of type real: R(0.5f). Only values that float holds exactly. */
#define R(x) ((real)(x))
#define INFINITE ((real)INFINITY)

static inline int is_finite(real x)
{
    return fabs(x) < INFINITE;
}
/* The larger and the smaller of two numbers; b where a is none. fmax and fmin take care of either, and take longer. */
static inline real larger(real a, real b)
{
    return a > b ? a : b;
}
static inline real smaller(real a, real b)
{
    return a < b ? a : b;
}
static inline real square(real x)
{
    return x * x;
}

#endif
