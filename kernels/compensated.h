/* Arithmetic that keeps what rounding would lose. */
#ifndef CLUCIDA_COMPENSATED_H
#define CLUCIDA_COMPENSATED_H

#include "kernels/real.h"

/* a b - c d to within 1.5 ulp (Kahan; Jeannerod, Louvet, Muller 2013). */
INLINED real difference_of_products(real a, real b, real c, real d)
{
    const real w = c * d;
    const real e = fma(-c, d, w);
    return fma(a, b, -w) + e;
}

/* What the rounded difference a - b leaves out (Knuth's two-sum). */
INLINED real difference_error(real a, real b)
{
    const real d = a - b;
    const real z = d - a;
    return (a - (d - z)) - (b + z);
}

/* A sum of products with the rounding errors carried along (Dot2: Ogita, Rump, Oishi 2005). */
typedef struct {
    real sum, error;
} Sum;

INLINED void sum_add(Sum* s, real a)
{
    const real t = s->sum + a;
    const real z = t - s->sum;
    s->error += (s->sum - (t - z)) + (a - z);
    s->sum = t;
}

INLINED void sum_product(Sum* s, real a, real b)
{
    const real p = a * b;
    s->error += fma(a, b, -p);
    sum_add(s, p);
}

INLINED real sum_value(Sum s)
{
    return s.sum + s.error;
}

/* A number to about twice the precision: hi + lo, hi the number rounded. */
typedef struct {
    real hi, lo;
} Twofold;

INLINED Twofold make_twofold(real a)
{
    Twofold t;
    t.hi = a;
    t.lo = R(0);
    return t;
}

/* Exact if s is 0 or a power of two. */
INLINED Twofold twofold_scaled(Twofold a, real s)
{
    a.hi *= s;
    a.lo *= s;
    return a;
}

INLINED Twofold sum_twofold(Sum s)
{
    Twofold t;
    t.hi = s.sum + s.error;
    t.lo = s.error - (t.hi - s.sum);
    return t;
}

INLINED void sum_twofold_product(Sum* s, Twofold a, Twofold b)
{
    sum_product(s, a.hi, b.hi);
    s->error += fma(a.hi, b.lo, a.lo * b.hi);
}

/* a b - c d. */
INLINED Twofold twofold_difference_of_products(real a, real b, real c, real d)
{
    const real p = a * b, q = c * d;
    Sum s;
    s.sum = p - q;
    s.error = difference_error(p, q) + (fma(a, b, -p) - fma(c, d, -q));
    return sum_twofold(s);
}

/* a / b, to about two units. */
INLINED real twofold_ratio(Twofold a, Twofold b)
{
    const real q = a.hi / b.hi;
    return q + (fma(-q, b.hi, a.hi) + fma(-q, b.lo, a.lo)) / b.hi;
}

#endif
