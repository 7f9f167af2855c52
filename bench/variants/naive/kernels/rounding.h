/* The naive variant: what is nearer than a fixed length, the same in every scene, has been passed, or coincides. */
#ifndef CLUCIDA_ROUNDING_H
#define CLUCIDA_ROUNDING_H

#include "kernels/epsilon.h"
#include "kernels/line.h"

static inline real position_error(vec o, real t)
{
    (void)o;
    (void)t;
    return EPSILON;
}
static inline real line_error(const Line* line, real t)
{
    (void)line;
    (void)t;
    return EPSILON;
}
static inline real stored_error(const Line* line, real t)
{
    return line_error(line, t);
}
static inline real place_error(const Line* line, real x, real err)
{
    (void)err;
    return line_error(line, x);
}
static inline real surface_error(const Line* line, real at, vec p)
{
    (void)p;
    return line_error(line, at);
}

static inline int passed(real t, real slope, real x, real doubt)
{
    (void)slope;
    return t <= x + doubt;
}

/* No primitive is known to have been left. */
static inline int just_left(const Line* line, u32 member)
{
    (void)line;
    (void)member;
    return 0;
}

static inline real crossing_error(const Line* line, const Crossing* c)
{
    (void)line;
    (void)c;
    return R(0);
}

static inline int coincides(Crossing nearest, Crossing c)
{
    return c.t - nearest.t <= EPSILON;
}

static inline real distance_at(const Crossing* c, real t)
{
    (void)c;
    (void)t;
    return R(0);
}

#endif
