/* Every other surface of second degree: cylinder, cone, paraboloid, hyperboloid, saddle, ellipsoid, in the frame that
 * makes its coefficients 0, 1 and -1 (layout.h). docs/numerics.md has the method. */
#ifndef CLUCIDA_QUADRIC_H
#define CLUCIDA_QUADRIC_H

#include "kernels/span.h"

/* Half the gradient at X, in the quadric's frame. */
static inline vec quadric_half_gradient(__global const LayoutQuadric* q, vec x)
{
    return make_vec(R(q->s[0]) * x.x, R(q->s[1]) * x.y, fma(R(q->s[2]), x.z, R(-q->g)));
}

static inline real quadric_slope(__global const LayoutQuadric* q, vec x, real half_derivative)
{
    const vec g = apply_transposed(q->m, quadric_half_gradient(q, x));
    return sqrt(dot3(g, g)) / fabs(half_derivative);
}

static inline real quadric_value(__global const LayoutQuadric* q, vec x)
{
    Sum sum = {R(q->w), R(0)};
    sum_product(&sum, R(q->s[0]) * x.x, x.x);
    sum_product(&sum, R(q->s[1]) * x.y, x.y);
    sum_product(&sum, fma(R(q->s[2]), x.z, R(-2) * R(q->g)), x.z);
    return sum_value(sum);
}

/* A line in the quadric's frame, q(x + t d) = a t^2 + 2 b t + c, and its discriminant b^2 - a c. All are functions of x
 * and d as they are: what rounding does to these two moves the line by as much, and nothing else does. */
typedef struct {
    vec x, d;
    real a, b, c, discriminant;
} QuadricLine;

/* b^2 - a c without its cancellation, from the moment k = x cross d:
 * -(s0 s1 kz^2 + s1 s2 kx^2 + s0 s2 ky^2) - w a + g^2 dz^2 + 2 g (s0 dx ky - s1 dy kx). */
static inline real quadric_discriminant(__global const LayoutQuadric* q, vec x, vec d)
{
    const real s0 = R(q->s[0]), s1 = R(q->s[1]), s2 = R(q->s[2]), g = R(q->g), w = R(q->w);
    const Twofold kx = twofold_difference_of_products(x.y, d.z, x.z, d.y);
    const Twofold ky = twofold_difference_of_products(x.z, d.x, x.x, d.z);
    const Twofold kz = twofold_difference_of_products(x.x, d.y, x.y, d.x);
    Sum s = {R(0), R(0)};
    sum_twofold_product(&s, twofold_scaled(kz, -s0 * s1), kz);
    if (g != R(0)) {
        sum_product(&s, g * g * d.z, d.z);
        sum_twofold_product(&s, twofold_scaled(ky, R(2) * g), make_twofold(s0 * d.x));
        sum_twofold_product(&s, twofold_scaled(kx, R(-2) * g), make_twofold(s1 * d.y));
    } else {
        sum_twofold_product(&s, twofold_scaled(kx, -s1 * s2), kx);
        sum_twofold_product(&s, twofold_scaled(ky, -s0 * s2), ky);
        sum_product(&s, -w * s0 * d.x, d.x);
        sum_product(&s, -w * s1 * d.y, d.y);
        sum_product(&s, -w * s2 * d.z, d.z);
    }
    return sum_value(s);
}

static inline QuadricLine quadric_line(__global const LayoutQuadric* q, const Line* line)
{
    QuadricLine l;
    l.x = apply(q->m, sub(line->base, load_vec(q->c)));
    l.d = apply(q->m, line->d);
    const vec part = make_vec(R(q->s[0]) * l.d.x, R(q->s[1]) * l.d.y, R(q->s[2]) * l.d.z);
    l.a = dot_exact(part, l.d);
    Sum b = {R(0), R(0)};
    sum_product(&b, part.x, l.x.x);
    sum_product(&b, part.y, l.x.y);
    sum_product(&b, part.z, l.x.z);
    sum_product(&b, R(-q->g), l.d.z);
    l.b = sum_value(b);
    l.c = quadric_value(q, l.x);
    l.discriminant = quadric_discriminant(q, l.x, l.d);
    if (l.a * l.c < R(0)) l.discriminant = fmax(l.discriminant, l.b * l.b);
    return l;
}

/* A row of the frame times a vector that is known to twice the precision: v + lost. */
static inline Twofold quadric_coordinate(__global const float* row, vec v, vec lost)
{
    const vec m = load_vec(row);
    Sum s = {R(0), R(0)};
    sum_product(&s, m.x, v.x);
    sum_product(&s, m.y, v.y);
    sum_product(&s, m.z, v.z);
    s.error += dot3(m, lost);
    return sum_twofold(s);
}

/* The other end where the ray has just left the quadric: -2 b/a from its start, which lies on it by definition. b fades
 * as the ray grows flat, and a along an asymptote or a generator; both keep their relative precision here. */
static inline real quadric_deflated(__global const LayoutQuadric* q, const Line* line)
{
    const vec c = load_vec(q->c), none = make_vec(R(0), R(0), R(0));
    const vec o = sub(line->origin, c);
    const vec lost =
        add(line_lost(line), make_vec(difference_error(line->origin.x, c.x), difference_error(line->origin.y, c.y),
                                      difference_error(line->origin.z, c.z)));
    Sum a = {R(0), R(0)}, b = {R(0), R(0)};
    for (int i = 0; i < 3; i++) {
        const Twofold x = quadric_coordinate(q->m + 3 * i, o, lost),
                      v = quadric_coordinate(q->m + 3 * i, line->d, none);
        const Twofold part = twofold_scaled(v, R(q->s[i]));
        sum_twofold_product(&a, part, v);
        sum_twofold_product(&b, part, x);
        if (i == 2) sum_twofold_product(&b, make_twofold(R(-q->g)), v);
    }
    const Twofold leading = sum_twofold(a);
    return leading.hi == R(0) ? R(0) : twofold_ratio(twofold_scaled(sum_twofold(b), R(-2)), leading);
}

/* The span where the ray has just left the quadric, from what the line has of it. An end ahead is where the start's
 * being on it puts it, by deflation; but from far off, unless rounding blurs that too much for the chord's length,
 * where the line meets the quadric. */
static inline Span quadric_span_left(__global const LayoutQuadric* q, const Line* line, real a, Span span)
{
    const real start = line->start;
    if ((a > R(0)) != (line->left_inside != 0)) return span_left(line, a, span.lo, span.slope_lo);
    const real blur = span.slope_lo * line_error(line, start) + span.slope_hi * line_error(line, span.hi);
    if (a != R(0) && (start == R(0) || !(span.hi - start > R(2) * blur))) span.hi = start + quadric_deflated(q, line);
    return span_left(line, a, span.hi, span.slope_hi);
}

static inline Span quadric_span(__global const LayoutQuadric* q, const Line* line, int left)
{
    const QuadricLine l = quadric_line(q, line);
    Span span;
    if (l.discriminant > R(0)) {
        const real root = sqrt(l.discriminant);
        const real s = -(l.b + copysign(root, l.b));
        const real t1 = l.c / s;
        if (l.a == R(0)) {
            span = l.b > R(0) ? make_span(-INFINITE, t1, R(0), 1) : make_span(t1, INFINITE, R(0), 1);
        } else {
            const real t2 = s / l.a;
            span = make_span(fmin(t1, t2), fmax(t1, t2), R(0), l.a > R(0));
        }
        if (is_finite(span.lo)) span.slope_lo = quadric_slope(q, along(l.x, l.d, span.lo), root);
        if (is_finite(span.hi)) span.slope_hi = quadric_slope(q, along(l.x, l.d, span.hi), root);
    } else {
        span = (l.a == R(0) ? l.c : l.a) < R(0) ? span_everything() : span_nothing();
    }
    return left ? quadric_span_left(q, line, l.a, span) : span;
}

/* Outward normal; *p makes one Newton step onto the surface. At a singular point (a cone's apex) any unit vector. */
static inline vec quadric_normal(__global const LayoutQuadric* q, vec* p)
{
    const vec x = apply(q->m, sub(*p, load_vec(q->c)));
    const vec g = apply_transposed(q->m, quadric_half_gradient(q, x));
    const real gg = dot3(g, g);
    if (!(gg > R(0))) return make_vec(R(0), R(0), R(1));
    *p = along(*p, g, R(-0.5f) * quadric_value(q, x) / gg);
    return renormalized(scaled(g, R(1) / sqrt(gg)));
}

#endif
