/* Eight doubles at once as two vectors of four, with a vector's operators: what wide.h has, of the native core in
 * double as C++. Of a vector that is wider than any register GCC 12 does comparisons and choices lane by lane, 8 times
 * slower. */
#ifndef CLUCIDA_HALVES_H
#define CLUCIDA_HALVES_H

#include "kernels/functions.h"

typedef real four_reals __attribute__((vector_size(4 * sizeof(real))));
typedef int64_t four_lanes __attribute__((vector_size(4 * sizeof(real))));

template <class Four>
struct Halves {
    Four lo, hi;
};
typedef Halves<four_reals> wide;
typedef Halves<four_lanes> wide_mask;
typedef wide_mask wide_id;

#define OPERATOR(op)                                                                                                   \
    template <class Four>                                                                                              \
    INLINED Halves<Four> operator op(Halves<Four> a, Halves<Four> b)                                                   \
    {                                                                                                                  \
        return {a.lo op b.lo, a.hi op b.hi};                                                                           \
    }                                                                                                                  \
    template <class Four>                                                                                              \
    INLINED void operator op##=(Halves<Four>& a, Halves<Four> b)                                                       \
    {                                                                                                                  \
        a = a op b;                                                                                                    \
    }
#define OPERATOR_WITH_REAL(op)                                                                                         \
    INLINED wide operator op(wide a, real b)                                                                           \
    {                                                                                                                  \
        return {a.lo op b, a.hi op b};                                                                                 \
    }                                                                                                                  \
    INLINED wide operator op(real a, wide b)                                                                           \
    {                                                                                                                  \
        return {a op b.lo, a op b.hi};                                                                                 \
    }
#define COMPARISON(op)                                                                                                 \
    template <class Four>                                                                                              \
    INLINED wide_mask operator op(Halves<Four> a, Halves<Four> b)                                                      \
    {                                                                                                                  \
        return {(four_lanes)(a.lo op b.lo), (four_lanes)(a.hi op b.hi)};                                               \
    }
OPERATOR(+)
OPERATOR(-)
OPERATOR(*)
OPERATOR(/)
OPERATOR(&)
OPERATOR(|)
OPERATOR(^)
OPERATOR_WITH_REAL(+)
OPERATOR_WITH_REAL(-)
OPERATOR_WITH_REAL(*)
OPERATOR_WITH_REAL(/)
COMPARISON(<)
COMPARISON(>)
COMPARISON(<=)
COMPARISON(>=)
COMPARISON(==)
COMPARISON(!=)
#undef OPERATOR
#undef OPERATOR_WITH_REAL
#undef COMPARISON

INLINED wide_id operator<<(wide_id a, int places)
{
    return {a.lo << places, a.hi << places};
}
INLINED wide_id operator>>(wide_id a, int places)
{
    return {a.lo >> places, a.hi >> places};
}
INLINED wide operator-(wide a)
{
    return {-a.lo, -a.hi};
}
INLINED wide_mask operator~(wide_mask a)
{
    return {~a.lo, ~a.hi};
}

/* Lanes of a type for those of another in memory, and back. */
template <class Four, class Stored>
INLINED Halves<Four> load_halves(const Stored* lanes)
{
    typedef Stored stored_four __attribute__((vector_size(4 * sizeof(Stored))));
    stored_four lo, hi;
    memcpy(&lo, lanes, sizeof lo);
    memcpy(&hi, lanes + 4, sizeof hi);
    return {__builtin_convertvector(lo, Four), __builtin_convertvector(hi, Four)};
}
template <class Four, class Stored>
INLINED void store_halves(Halves<Four> a, Stored* lanes)
{
    typedef Stored stored_four __attribute__((vector_size(4 * sizeof(Stored))));
    const stored_four lo = __builtin_convertvector(a.lo, stored_four), hi = __builtin_convertvector(a.hi, stored_four);
    memcpy(lanes, &lo, sizeof lo);
    memcpy(lanes + 4, &hi, sizeof hi);
}

INLINED wide load_wide(const float* p)
{
    return load_halves<four_reals>(p);
}
INLINED wide_mask load_wide_u32(const u32* p)
{
    return load_halves<four_lanes>(p);
}
INLINED void store_wide(wide a, real lanes[LANES])
{
    store_halves(a, lanes);
}
INLINED wide load_lanes(const real lanes[LANES])
{
    return load_halves<four_reals>(lanes);
}
INLINED wide_id load_ids(const int lanes[LANES])
{
    return load_halves<four_lanes>(lanes);
}
INLINED void store_ids(wide_id a, int lanes[LANES])
{
    store_halves(a, lanes);
}
INLINED wide_id all_ids(int x)
{
    const four_lanes a = {x, x, x, x};
    return {a, a};
}
INLINED wide wide_all(real x)
{
    const four_reals a = {x, x, x, x};
    return {a, a};
}
INLINED wide wide_of_ids(wide_id a)
{
    return {__builtin_convertvector(a.lo, four_reals), __builtin_convertvector(a.hi, four_reals)};
}
INLINED wide wide_fma(wide a, wide b, wide c)
{
    for (u32 i = 0; i < 4; i++) a.lo[i] = fma(a.lo[i], b.lo[i], c.lo[i]);
    for (u32 i = 0; i < 4; i++) a.hi[i] = fma(a.hi[i], b.hi[i], c.hi[i]);
    return a;
}
INLINED wide wide_fabs(wide a)
{
    for (u32 i = 0; i < 4; i++) a.lo[i] = fabs(a.lo[i]);
    for (u32 i = 0; i < 4; i++) a.hi[i] = fabs(a.hi[i]);
    return a;
}
INLINED wide wide_sqrt(wide a)
{
    for (u32 i = 0; i < 4; i++) a.lo[i] = sqrt(a.lo[i]);
    for (u32 i = 0; i < 4; i++) a.hi[i] = sqrt(a.hi[i]);
    return a;
}
INLINED wide wide_copysign(wide a, wide b)
{
    for (u32 i = 0; i < 4; i++) a.lo[i] = copysign(a.lo[i], b.lo[i]);
    for (u32 i = 0; i < 4; i++) a.hi[i] = copysign(a.hi[i], b.hi[i]);
    return a;
}
INLINED wide wide_exp(wide a)
{
    for (u32 i = 0; i < 4; i++) a.lo[i] = exp(a.lo[i]);
    for (u32 i = 0; i < 4; i++) a.hi[i] = exp(a.hi[i]);
    return a;
}
INLINED wide_id id_select(wide_id a, wide_id b, wide_mask mask)
{
    return (mask & b) | (~mask & a);
}
INLINED wide wide_select(wide a, wide b, wide_mask mask)
{
    return {(four_reals)((mask.lo & (four_lanes)b.lo) | (~mask.lo & (four_lanes)a.lo)),
            (four_reals)((mask.hi & (four_lanes)b.hi) | (~mask.hi & (four_lanes)a.hi))};
}
INLINED wide_mask wide_is(wide_mask a, u32 x)
{
    const int64_t same = x;
    return {(four_lanes)(a.lo == same), (four_lanes)(a.hi == same)};
}
INLINED real wide_largest(wide a)
{
    const real x = larger(larger(a.lo[0], a.hi[0]), larger(a.lo[2], a.hi[2]));
    const real y = larger(larger(a.lo[1], a.hi[1]), larger(a.lo[3], a.hi[3]));
    return larger(x, y);
}
INLINED u32 wide_bits(wide_mask m)
{
#ifdef __AVX__
    const int lo = __builtin_ia32_movmskpd256((four_reals)m.lo), hi = __builtin_ia32_movmskpd256((four_reals)m.hi);
    return (u32)(lo | hi << 4);
#else
    u32 bits = 0;
    for (u32 i = 0; i < 4; i++) bits |= (u32)(m.lo[i] & 1) << i | (u32)(m.hi[i] & 1) << (i + 4);
    return bits;
#endif
}

#endif
