/* What a solid holds of a line: one interval, or all but one interval.
 *
 * Parameters are lengths along the line from its base (csg.h chooses it). Each end knows its face (the primitive) and
 * its slope, 1/cos of the angle of incidence: a point that is wrong by e puts the end wrong by e * slope. */
#ifndef CLUCIDA_SPAN_H
#define CLUCIDA_SPAN_H

#include "kernels/world.h"

typedef struct {
    vec base, d; /* base relative to the object's centre */
    vec origin;  /* the ray's origin, relative to the centre too */
    real start;  /* parameter of the ray's origin */
    real err;    /* of the origin: Ray's */
    real dd;     /* |d|^2 */
    real grain;  /* the object's */
    u32 left;
    int left_inside;
} Line;

typedef struct {
    real lo, hi;
    real slope_lo, slope_hi;
    u32 face_lo, face_hi;
    int keep; /* inside is lo..hi; else inside is all but lo..hi */
} Span;

static inline Span make_span(real lo, real hi, real slope, int keep)
{
    Span s;
    s.lo = lo;
    s.hi = hi;
    s.slope_lo = s.slope_hi = slope;
    s.face_lo = s.face_hi = MEMBER_NONE;
    s.keep = keep;
    return s;
}

static inline Span span_nothing(void)
{
    return make_span(INFINITE, -INFINITE, R(0), 1);
}
static inline Span span_everything(void)
{
    return make_span(-INFINITE, INFINITE, R(0), 1);
}

/* The error of a parameter t on this line, for a surface met at right angles: by arithmetic, and by what members were
 * stored to, which counts between objects that store the same surface each in its own way. */
static inline real line_error(const Line* line, real t)
{
    return ROUNDINGS * UNIT_ROUNDOFF * fmax(fmax(largest(line->base), fabs(t)), line->grain);
}
static inline real stored_error(const Line* line, real t)
{
    return R(STORED_ROUNDOFF / UNIT_ROUNDOFF) * line_error(line, t);
}

/* How well a boundary's place about x is known: among the object's own by arithmetic alone (err = 0); where other
 * objects' boundaries are crossed too, to within err, by how all were stored. */
static inline real place_error(const Line* line, real x, real err)
{
    return err > R(0) ? stored_error(line, x) + err : line_error(line, x);
}

/* Whether an end at t lies before x, or so near after it that rounding cannot tell: the point at x is (t - x)/slope
 * away from the surface. */
static inline int passed(const Line* line, real t, real slope, real x, real err)
{
    return t <= x || (is_finite(t) && t - x <= slope * place_error(line, x, err));
}

/* The span of a primitive that the ray has just left: one end is where the ray starts, exactly; the other lies
 * `other` further on, by deflation of the known root, and has the slope. a is the leading coefficient, which tells
 * whether the inside lies between the roots (> 0), outside them (< 0), or whether there is one root only. */
static inline Span span_left(const Line* line, real a, real other, real slope)
{
    const int between = (a > R(0)) == (line->left_inside != 0); /* the far end lies ahead */
    Span s;
    if (a == R(0)) {
        s = line->left_inside ? make_span(line->start, INFINITE, slope, 1)
                              : make_span(-INFINITE, line->start, slope, 1);
        return s;
    }
    other = between ? fmax(other, R(0)) : fmin(other, R(0));
    s = between ? make_span(line->start, line->start + other, slope, a > R(0))
                : make_span(line->start + other, line->start, slope, a > R(0));
    /* The deflated root is good to a few units of itself: never mistake it for the start. */
    const real cap = R(0.25f) * fabs(other) / place_error(line, line->start, line->err);
    if (between)
        s.slope_hi = fmin(slope, cap);
    else
        s.slope_lo = fmin(slope, cap);
    return s;
}

#endif
