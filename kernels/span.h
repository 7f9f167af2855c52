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

/* What a chord that begins at `start` measures at least: however short it is, it has a length. */
static inline real least_chord(real start)
{
    return fma(R(4) * UNIT_ROUNDOFF, fabs(start), R(1e-30f));
}

/* The span of a primitive that the ray has just left: one end is where the ray starts, exactly; the other lies at `end`
 * and has the slope. a is the leading coefficient, which tells whether the inside lies between the roots (> 0), outside
 * them (< 0), or whether there is one root only. */
static inline Span span_left(const Line* line, real a, real end, real slope)
{
    const real start = line->start;
    const int ahead = (a > R(0)) == (line->left_inside != 0);
    Span s;
    if (a == R(0))
        return line->left_inside ? make_span(start, INFINITE, slope, 1) : make_span(-INFINITE, start, slope, 1);
    /* On its way the ray is on the side that it went to. */
    const real least = least_chord(start);
    end = ahead ? larger(end, start + least) : smaller(end, start - least);
    s = ahead ? make_span(start, end, slope, a > R(0)) : make_span(end, start, slope, a > R(0));
    /* Rounding blurs the end, but not as far as the start: never mistake it for that. */
    const real cap = R(0.25f) * fabs(end - start) / place_error(line, start, line->err);
    if (ahead)
        s.slope_hi = smaller(slope, cap);
    else
        s.slope_lo = smaller(slope, cap);
    return s;
}

#endif
