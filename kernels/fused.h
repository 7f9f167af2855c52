/* fma for devices that have none but a long routine, which their compilers copy to each of its hundred calls
 * (docs/portability.md): of plain sums and products, with one rounding all the same. */
#ifndef CLUCIDA_FUSED_H
#define CLUCIDA_FUSED_H

/* What the rounded product p = a b leaves out (Dekker 1971). */
static inline float product_error(float a, float b, float p)
{
    const float a_long = 4097.0f * a, b_long = 4097.0f * b;
    const float a_hi = a_long - (a_long - a), b_hi = b_long - (b_long - b);
    const float a_lo = a - a_hi, b_lo = b - b_hi;
    return a_lo * b_lo - (((p - a_hi * b_hi) - a_lo * b_hi) - a_hi * b_lo);
}

/* What the rounded sum s = a + b leaves out (Knuth's two-sum). */
static inline float sum_error(float a, float b, float s)
{
    const float z = s - a;
    return (a - (s - z)) + (b - z);
}

/* a b + c: the sum of the errors is rounded to odd, so that the last rounding is right (Boldo and Melquiond 2008). To
 * the bit what fma gives while the product and its error stay within float's normal range; beyond, as a b + c. */
static inline float fused(float a, float b, float c)
{
    const float p = a * b, p_error = product_error(a, b, p);
    const float t = c + p_error, t_error = sum_error(c, p_error, t);
    const float v = p + t, v_error = sum_error(p, t, v);
    const float rest = t_error + v_error, lost = sum_error(t_error, v_error, rest);
    const int bits = as_int(rest), odd = bits + ((as_int(lost) ^ bits) < 0 ? -1 : 1);
    const float sum = v + as_float(lost != 0.0f && !(bits & 1) ? odd : bits);
    return fabs(sum) < INFINITY ? sum : p + c;
}

/* The same in each of eight lanes. */
static inline float8 fused8(float8 a, float8 b, float8 c)
{
    return (float8)(fused(a.s0, b.s0, c.s0), fused(a.s1, b.s1, c.s1), fused(a.s2, b.s2, c.s2), fused(a.s3, b.s3, c.s3),
                    fused(a.s4, b.s4, c.s4), fused(a.s5, b.s5, c.s5), fused(a.s6, b.s6, c.s6), fused(a.s7, b.s7, c.s7));
}

#define fma fused
#define fma8 fused8

#endif
