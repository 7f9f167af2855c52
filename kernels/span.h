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
    real chord; /* how long the line runs behind the surface of its low end */
    u32 face_lo, face_hi;
    int keep; /* inside is lo..hi; else inside is all but lo..hi */
} Span;

static inline Span make_span(real lo, real hi, real slope, int keep)
{
    Span s;
    s.lo = lo;
    s.hi = hi;
    s.slope_lo = s.slope_hi = slope;
    s.chord = hi - lo;
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

/* The span of a primitive that the ray has just left and does not meet again: it starts or ends where the ray does. */
static inline Span span_left(const Line* line)
{
    return line->left_inside ? make_span(line->start, INFINITE, R(0), 1) : make_span(-INFINITE, line->start, R(0), 1);
}

/* What a chord that begins at `start` measures at least: however short it is, it has a length. */
static inline real least_chord(real start)
{
    return fma(R(4) * UNIT_ROUNDOFF, fabs(start), R(1e-30f));
}

/* The span of a primitive that the ray has just left and meets again at `end`, at this slope. */
static inline Span span_chord(const Line* line, real end, real slope)
{
    /* On its way the ray is on the side that it went to. */
    const real start = line->start;
    Span s = make_span(start, larger(end, start + least_chord(start)), slope, line->left_inside);
    /* Rounding blurs the end, but not as far as the start: never mistake it for that. */
    s.slope_hi = smaller(slope, R(0.25f) * (s.hi - start) / place_error(line, start, line->err));
    return s;
}

#endif
