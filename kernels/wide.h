/* Eight reals at once, for what is done eight times over. */
#ifndef CLUCIDA_WIDE_H
#define CLUCIDA_WIDE_H

#include "kernels/vec.h"

#define LANES 8u

/* What one instruction does where there is one: a bit of each lane's sign. */
#if defined(__AVX__) && !defined(CLU_DOUBLE)
typedef float avx_float8 __attribute__((vector_size(32)));
#define WIDE_BITS(m) ((u32)__builtin_ia32_movmskps256((avx_float8)(m)))
#endif

/* A lane of a mask is all ones or 0. The native build has GNU C's vectors, which know fewer operations. */
#ifdef __OPENCL_VERSION__
#ifdef CLU_DOUBLE
typedef double8 wide;
typedef long8 wide_mask;
#define CONVERT_WIDE(x) convert_double8(x)
#define CONVERT_MASK(x) convert_long8(x)
#else
typedef float8 wide;
typedef int8 wide_mask;
#define CONVERT_WIDE(x) (x)
#define CONVERT_MASK(x) as_int8(x)
#endif

INLINED wide load_wide(__global const float* p)
{
    return CONVERT_WIDE(vload8(0, p));
}
INLINED wide_mask load_wide_u32(__global const u32* p)
{
    return CONVERT_MASK(vload8(0, p));
}
INLINED void store_wide(wide a, real lanes[LANES])
{
    vstore8(a, 0, lanes);
}
INLINED wide wide_all(real x)
{
    return (wide)(x);
}
INLINED wide wide_fma(wide a, wide b, wide c)
{
    return fma(a, b, c);
}
INLINED wide wide_fabs(wide a)
{
    return fabs(a);
}
/* b where the mask is set, else a. */
INLINED wide wide_select(wide a, wide b, wide_mask mask)
{
    return mask ? b : a;
}
INLINED wide_mask wide_is(wide_mask a, u32 x)
{
    return a == (wide_mask)(x);
}
INLINED real wide_largest(wide a)
{
    const real x = larger(larger(a.s0, a.s4), larger(a.s2, a.s6)), y = larger(larger(a.s1, a.s5), larger(a.s3, a.s7));
    return larger(x, y);
}
INLINED u32 wide_bits(wide_mask m)
{
#ifdef WIDE_BITS
    return WIDE_BITS(m);
#else
    const wide_mask b = m & (wide_mask)(1, 2, 4, 8, 16, 32, 64, 128);
    return (u32)((b.s0 | b.s4) | (b.s2 | b.s6) | (b.s1 | b.s5) | (b.s3 | b.s7));
#endif
}

#undef CONVERT_WIDE
#undef CONVERT_MASK
#else
#ifdef CLU_DOUBLE
typedef int64_t wide_lane;
#else
typedef int32_t wide_lane;
#endif
typedef real wide __attribute__((vector_size(8 * sizeof(real))));
typedef wide_lane wide_mask __attribute__((vector_size(8 * sizeof(real))));

INLINED wide load_wide(const float* p)
{
    wide a;
    for (u32 i = 0; i < LANES; i++) a[i] = R(p[i]);
    return a;
}
INLINED wide_mask load_wide_u32(const u32* p)
{
    wide_mask a;
    for (u32 i = 0; i < LANES; i++) a[i] = (wide_lane)p[i];
    return a;
}
INLINED void store_wide(wide a, real lanes[LANES])
{
    for (u32 i = 0; i < LANES; i++) lanes[i] = a[i];
}
INLINED wide wide_all(real x)
{
    const wide a = {x, x, x, x, x, x, x, x};
    return a;
}
INLINED wide wide_fma(wide a, wide b, wide c)
{
    for (u32 i = 0; i < LANES; i++) a[i] = fma(a[i], b[i], c[i]);
    return a;
}
INLINED wide wide_fabs(wide a)
{
    for (u32 i = 0; i < LANES; i++) a[i] = fabs(a[i]);
    return a;
}
INLINED wide wide_select(wide a, wide b, wide_mask mask)
{
    return (wide)((mask & (wide_mask)b) | (~mask & (wide_mask)a));
}
INLINED wide_mask wide_is(wide_mask a, u32 x)
{
    return a == (wide_lane)x;
}
INLINED real wide_largest(wide a)
{
    real most = a[0];
    for (u32 i = 1; i < LANES; i++) most = larger(most, a[i]);
    return most;
}
INLINED u32 wide_bits(wide_mask m)
{
#ifdef WIDE_BITS
    return WIDE_BITS(m);
#else
    u32 bits = 0;
    for (u32 i = 0; i < LANES; i++) bits |= (u32)(m[i] & 1) << i;
    return bits;
#endif
}
#endif

INLINED wide wide_smaller(wide a, wide b)
{
    return wide_select(b, a, a < b);
}
INLINED wide wide_larger(wide a, wide b)
{
    return wide_select(b, a, a > b);
}
INLINED real wide_smallest(wide a)
{
    return -wide_largest(-a);
}
/* The least lane of a set of bits that is not empty. */
INLINED u32 first_lane(u32 bits)
{
#ifdef __OPENCL_VERSION__
    return 31u - clz(bits & -bits);
#else
    return (u32)__builtin_ctz(bits);
#endif
}

#endif
