/* Eight reals at once, for what is done eight times over. */
#ifndef CLUCIDA_WIDE_H
#define CLUCIDA_WIDE_H

#include "kernels/functions.h"
#include "kernels/vec.h"

#define LANES 8u

/* What one instruction does where there is one: a bit of each lane's sign. */
#if defined(__AVX512DQ__) && defined(__AVX512VL__) && !defined(CLU_DOUBLE)
typedef int avx_int8 __attribute__((vector_size(32)));
#define WIDE_BITS(m) ((u32)__builtin_ia32_cvtd2mask256((avx_int8)(m)) & 255u)
#elif defined(__AVX__) && !defined(CLU_DOUBLE)
typedef float avx_float8 __attribute__((vector_size(32)));
#define WIDE_BITS(m) ((u32)__builtin_ia32_movmskps256((avx_float8)(m)))
#endif

/* A lane of a mask is all ones or 0. The native build has GNU C's vectors, which know fewer operations; in double,
 * as C++, pairs of them. */
#ifdef __OPENCL_VERSION__
#ifdef CLU_DOUBLE
typedef double8 wide;
typedef long8 wide_mask;
#define CONVERT_WIDE(x) convert_double8(x)
#define CONVERT_MASK(x) convert_long8(x)
#define CONVERT_IDS(x) convert_long8(x)
#else
typedef float8 wide;
typedef int8 wide_mask;
#define CONVERT_WIDE(x) (x)
#define CONVERT_MASK(x) as_int8(x)
#define CONVERT_IDS(x) (x)
#endif
typedef wide_mask wide_id; /* a signed 32-bit number in each lane */

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
INLINED wide load_lanes(const real lanes[LANES])
{
    return vload8(0, lanes);
}
INLINED wide_id load_ids(const int lanes[LANES])
{
    return CONVERT_IDS(vload8(0, lanes));
}
INLINED void store_ids(wide_id a, int lanes[LANES])
{
    vstore8(convert_int8(a), 0, lanes);
}
INLINED wide wide_all(real x)
{
    return (wide)(x);
}
INLINED wide_id all_ids(int x)
{
    return (wide_id)(x);
}
INLINED wide wide_of_ids(wide_id a)
{
#ifdef CLU_DOUBLE
    return convert_double8(a);
#else
    return convert_float8(a);
#endif
}
INLINED wide wide_fma(wide a, wide b, wide c)
{
    return fma8(a, b, c);
}
INLINED wide wide_fabs(wide a)
{
    return fabs(a);
}
INLINED wide wide_sqrt(wide a)
{
    return sqrt(a);
}
INLINED wide wide_copysign(wide a, wide b)
{
    return copysign(a, b);
}
/* 2^n where n is a wide's last bits (kernels/functions.h); of doubles e^a. */
#ifdef CLU_DOUBLE
INLINED wide wide_exp(wide a)
{
    return exp(a);
}
#else
INLINED wide wide_power(wide shifted)
{
    return as_float8((as_uint8(shifted) << 23) + 0x3f800000u);
}
#endif
/* b where the mask is set, else a. */
INLINED wide wide_select(wide a, wide b, wide_mask mask)
{
    return mask ? b : a;
}
INLINED wide_id id_select(wide_id a, wide_id b, wide_mask mask)
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
#undef CONVERT_IDS
#elif defined(__cplusplus) && defined(CLU_DOUBLE)
#include "kernels/halves.h"
#else
#ifdef CLU_DOUBLE
typedef int64_t wide_lane;
#else
typedef int32_t wide_lane;
#endif
typedef real wide __attribute__((vector_size(8 * sizeof(real))));
typedef wide_lane wide_mask __attribute__((vector_size(8 * sizeof(real))));
typedef wide_mask wide_id;

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
INLINED wide load_lanes(const real lanes[LANES])
{
    wide a;
    for (u32 i = 0; i < LANES; i++) a[i] = lanes[i];
    return a;
}
INLINED wide_id load_ids(const int lanes[LANES])
{
    wide_id a;
    for (u32 i = 0; i < LANES; i++) a[i] = lanes[i];
    return a;
}
INLINED void store_ids(wide_id a, int lanes[LANES])
{
    for (u32 i = 0; i < LANES; i++) lanes[i] = (int)a[i];
}
INLINED wide_id all_ids(int x)
{
    const wide_id a = {x, x, x, x, x, x, x, x};
    return a;
}
INLINED wide wide_all(real x)
{
    const wide a = {x, x, x, x, x, x, x, x};
    return a;
}
INLINED wide wide_of_ids(wide_id a)
{
    wide x;
    for (u32 i = 0; i < LANES; i++) x[i] = (real)a[i];
    return x;
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
INLINED wide wide_sqrt(wide a)
{
    for (u32 i = 0; i < LANES; i++) a[i] = sqrt(a[i]);
    return a;
}
INLINED wide wide_copysign(wide a, wide b)
{
    for (u32 i = 0; i < LANES; i++) a[i] = copysign(a[i], b[i]);
    return a;
}
#ifdef CLU_DOUBLE
INLINED wide wide_exp(wide a)
{
    for (u32 i = 0; i < LANES; i++) a[i] = exp(a[i]);
    return a;
}
#else
INLINED wide wide_power(wide shifted)
{
    for (u32 i = 0; i < LANES; i++) shifted[i] = as_float((as_uint(shifted[i]) << 23) + 0x3f800000u);
    return shifted;
}
#endif
INLINED wide wide_select(wide a, wide b, wide_mask mask)
{
    return (wide)((mask & (wide_mask)b) | (~mask & (wide_mask)a));
}
INLINED wide_id id_select(wide_id a, wide_id b, wide_mask mask)
{
    return (mask & b) | (~mask & a);
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
/* decay (kernels/functions.h) in each lane, with the same roundings. */
INLINED wide wide_decay(wide x)
{
#ifdef CLU_DOUBLE
    return wide_exp(-x);
#else
    const wide shifted = wide_fma(x, wide_all(-LOG2_E), wide_all(ROUNDER)), n = shifted - wide_all(ROUNDER);
    const wide r = wide_fma(n, wide_all(-LN2_LOW), wide_fma(n, wide_all(-LN2_HIGH), -x));
    const wide value = EXP_POLYNOMIAL(wide_fma, wide_all, r) * wide_power(shifted);
    return wide_select(value, wide_all(0.0f), x > wide_all(MOST_DECAY));
#endif
}
INLINED int any_lane(wide_mask m)
{
    return wide_bits(m) != 0u;
}
INLINED u32 count_bits(u32 bits)
{
#ifdef __OPENCL_VERSION__
    return popcount(bits);
#else
    return (u32)__builtin_popcount(bits);
#endif
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
