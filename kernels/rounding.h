/* What rounding leaves in doubt: where a boundary lies, whether it has been passed, whether two coincide. No length
 * here is fixed: all come from the sizes of what was rounded. */
#ifndef CLUCIDA_ROUNDING_H
#define CLUCIDA_ROUNDING_H

#include "kernels/line.h"

/* Positions are good to a few roundings of their size: of the arithmetic within one object, of what coordinates are
 * stored to between objects. The factor is what flush faces need (tests of coincident faces), and small enough that
 * shells with a relative gap of 1e-6 stay apart. */
#define ROUNDINGS R(4)

static inline real position_error(vec o, real t)
{
    return ROUNDINGS * R(STORED_ROUNDOFF) * larger(largest(o), fabs(t));
}

/* The error of a parameter t on this line, for a surface met at right angles: by arithmetic, and by what members were
 * stored to, which counts between objects that store the same surface each in its own way. */
static inline real line_error(const Line* line, real t)
{
    return ROUNDINGS * UNIT_ROUNDOFF * larger(line->size, fabs(t));
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

/* Whether an end at t lies before x, or so near after it that rounding cannot tell: the point at x, known to within
 * doubt, is (t - x)/slope away from the surface. */
static inline int passed(real t, real slope, real x, real doubt)
{
    return t - x <= slope * doubt && t < INFINITE;
}

/* Whether the member (whatever side of it is meant) is the primitive that the ray has just left. */
static inline int just_left(const Line* line, u32 member)
{
    return (member & ~MEMBER_INVERSE) == line->left;
}

/* How far off the crossing may be. The primitive that the ray has left is met as if the ray began right on it: what the
 * origin is off counts against others that store the same surface. */
static inline real crossing_error(const Line* line, const Crossing* c)
{
    const real err = stored_error(line, c->at);
    return just_left(line, c->face) ? err + line->err : err;
}

/* Whether rounding cannot tell crossing c, no nearer than the nearest, from it. Each may be off across the ray by its
 * err, and along it as its slope makes of that; both by what the sum with the line's start rounds away. What is in
 * doubt is the nearest's place: a boundary met at a slant far beyond it is no less sure for being far. */
static inline int coincides(Crossing nearest, Crossing c)
{
    const real beyond = c.t - nearest.t;
    const real err = larger(c.err - ROUNDINGS * R(STORED_ROUNDOFF) * beyond, nearest.err);
    const real along_ray = fma(nearest.slope, nearest.err, R(4) * UNIT_ROUNDOFF * fabs(nearest.t));
    return beyond <= fma(c.slope, err, along_ray);
}

/* How far ray parameter t may be from the boundary, at right angles to it. */
static inline real distance_at(const Crossing* c, real t)
{
    return fabs(c->t - t) / larger(c->slope, R(1));
}

/* How far the surface's point p, at parameter `at`, may lie from the boundaries of objects that store it otherwise. */
static inline real surface_error(const Line* line, real at, vec p)
{
    return larger(position_error(p, R(0)), stored_error(line, at));
}

#endif
