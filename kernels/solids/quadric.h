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
static inline real quadric_discriminant(__global const LayoutQuadric* q, const QuadricLine* l)
{
    const real s0 = R(q->s[0]), s1 = R(q->s[1]), s2 = R(q->s[2]), g = R(q->g);
    const vec k = cross_exact(l->x, l->d);
    const real z = s0 * s1 * k.z;
    if (g != R(0)) {
        const real up = g * l->d.z, across = s0 * l->d.x * k.y - s1 * l->d.y * k.x;
        return fma(up, up, fma(R(2) * g, across, -z * k.z));
    }
    return fma(-z, k.z, fma(-s1 * s2 * k.x, k.x, fma(-s0 * s2 * k.y, k.y, R(-q->w) * l->a)));
}

/* The same sum with its rounding errors carried along. */
static inline real quadric_discriminant_exact(__global const LayoutQuadric* q, vec x, vec d)
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

/* Whether it is an ellipsoid, paraboloid or a cylinder over an ellipse or parabola, without asymptotes. */
static inline int quadric_is_convex(__global const LayoutQuadric* q)
{
    return q->s[0] >= 0.0f && q->s[1] >= 0.0f && q->s[2] >= 0.0f;
}

/* Near an asymptote, where a is less than this part of |d|^2, a fades, and b and the discriminant with it: there every
 * sum carries its rounding errors along. */
#define NEAR_ASYMPTOTE R(0.5f)

static inline void quadric_line_near_asymptote(__global const LayoutQuadric* q, vec part, QuadricLine* l)
{
    l->a = dot_exact(part, l->d);
    Sum b = {R(0), R(0)};
    sum_product(&b, part.x, l->x.x);
    sum_product(&b, part.y, l->x.y);
    sum_product(&b, part.z, l->x.z);
    sum_product(&b, R(-q->g), l->d.z);
    l->b = sum_value(b);
    l->c = quadric_value(q, l->x);
    l->discriminant = quadric_discriminant_exact(q, l->x, l->d);
}

static inline QuadricLine quadric_line(__global const LayoutQuadric* q, const Line* line)
{
    QuadricLine l;
    l.x = apply(q->m, sub(line->base, load_vec(q->c)));
    l.d = apply(q->m, line->d);
    const vec s = load_vec(q->s), part = make_vec(s.x * l.d.x, s.y * l.d.y, s.z * l.d.z);
    const real g = R(q->g);
    l.a = dot3(part, l.d);
    if (!quadric_is_convex(q) && fabs(l.a) < NEAR_ASYMPTOTE * dot3(l.d, l.d)) {
        quadric_line_near_asymptote(q, part, &l);
    } else {
        l.b = fma(-g, l.d.z, dot3(part, l.x));
        l.c = fma(s.x * l.x.x, l.x.x, fma(s.y * l.x.y, l.x.y, fma(fma(s.z, l.x.z, R(-2) * g), l.x.z, R(q->w))));
        l.discriminant = quadric_discriminant(q, &l);
    }
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

/* The line of a ray that has just left the quadric, from its start, which lies on it by definition: the other end is
 * -2 b/a from there. b fades as the ray grows flat, and a along an asymptote or a generator; both keep their relative
 * precision here. */
typedef struct {
    vec x, d;
    Twofold a, b;
} QuadricChord;

static inline QuadricChord quadric_chord(__global const LayoutQuadric* q, const Line* line)
{
    const vec c = load_vec(q->c), none = make_vec(R(0), R(0), R(0));
    const vec o = sub(line->origin, c);
    const vec lost =
        add(line_lost(line), make_vec(difference_error(line->origin.x, c.x), difference_error(line->origin.y, c.y),
                                      difference_error(line->origin.z, c.z)));
    Sum a = {R(0), R(0)}, b = {R(0), R(0)};
    real x[3], d[3];
    for (int i = 0; i < 3; i++) {
        const Twofold xi = quadric_coordinate(q->m + 3 * i, o, lost),
                      di = quadric_coordinate(q->m + 3 * i, line->d, none);
        const Twofold part = twofold_scaled(di, R(q->s[i]));
        sum_twofold_product(&a, part, di);
        sum_twofold_product(&b, part, xi);
        if (i == 2) sum_twofold_product(&b, make_twofold(R(-q->g)), di);
        x[i] = xi.hi;
        d[i] = di.hi;
    }
    QuadricChord chord;
    chord.x = make_vec(x[0], x[1], x[2]);
    chord.d = make_vec(d[0], d[1], d[2]);
    chord.a = sum_twofold(a);
    chord.b = sum_twofold(b);
    return chord;
}

/* The roots of a line whose discriminant is positive; with a = 0 there is one, in t[0]. */
static inline void quadric_roots(const QuadricLine* l, real root, real t[2])
{
    const real s = -(l->b + copysign(root, l->b));
    t[0] = l->c / s;
    t[1] = s / l->a;
}

/* The span of a quadric that the ray has just left. An end ahead is where the start's being on it puts it; but from far
 * off, unless rounding blurs that too much for the chord's length, where the line meets the quadric. */
static inline Span quadric_span_left(__global const LayoutQuadric* q, const Line* line)
{
    const QuadricChord chord = quadric_chord(q, line);
    const real start = line->start, a = chord.a.hi;
    if (a == R(0) || (a > R(0)) != (line->left_inside != 0)) return span_left(line);
    const real length = twofold_ratio(twofold_scaled(chord.b, R(-2)), chord.a);
    const real slope = quadric_slope(q, along(chord.x, chord.d, length), chord.b.hi);
    if (start == R(0)) return span_chord(line, length, slope);
    const QuadricLine l = quadric_line(q, line);
    if (l.discriminant > R(0) && l.a != R(0)) {
        real t[2];
        quadric_roots(&l, sqrt(l.discriminant), t);
        const real end = larger(t[0], t[1]), start_slope = quadric_slope(q, chord.x, chord.b.hi);
        const real blur = start_slope * line_error(line, start) + slope * line_error(line, end);
        if (end - start > R(2) * blur) return span_chord(line, end, slope);
    }
    return span_chord(line, start + length, slope);
}

static inline Span quadric_span(__global const LayoutQuadric* q, const Line* line, int left)
{
    if (left) return quadric_is_convex(q) && !line->left_inside ? span_left(line) : quadric_span_left(q, line);
    const QuadricLine l = quadric_line(q, line);
    if (!(l.discriminant > R(0))) return (l.a == R(0) ? l.c : l.a) < R(0) ? span_everything() : span_nothing();
    const real root = sqrt(l.discriminant);
    real t[2];
    quadric_roots(&l, root, t);
    Span span;
    if (l.a == R(0))
        span = l.b > R(0) ? make_span(-INFINITE, t[0], R(0), 1) : make_span(t[0], INFINITE, R(0), 1);
    else
        span = make_span(smaller(t[0], t[1]), larger(t[0], t[1]), R(0), l.a > R(0));
    if (is_finite(span.lo)) span.slope_lo = quadric_slope(q, along(l.x, l.d, span.lo), root);
    if (is_finite(span.hi)) span.slope_hi = quadric_slope(q, along(l.x, l.d, span.hi), root);
    return span;
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
