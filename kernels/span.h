/* What a solid holds of a line: one interval, or all but one interval.
 *
 * Parameters are lengths along the line from its base (line.h chooses it). Each end knows its face (the primitive) and
 * its slope, 1/cos of the angle of incidence: a point that is wrong by e puts the end wrong by e * slope. */
#ifndef CLUCIDA_SPAN_H
#define CLUCIDA_SPAN_H

#include "kernels/rounding.h"

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
