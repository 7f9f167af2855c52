/* A ray as an object sees it, and a boundary that it meets. */
#ifndef CLUCIDA_LINE_H
#define CLUCIDA_LINE_H

#include "kernels/world.h"

typedef struct {
    vec base, d;   /* base relative to the object's centre */
    vec origin;    /* the ray's origin, relative to the centre too */
    vec o, center; /* both relative to the eye */
    real start;    /* parameter of the ray's origin */
    real err;      /* of the origin: Ray's */
    real excess;   /* |d|^2 - 1 */
    real size;     /* of the numbers that places on the line are computed from */
    u32 left;
    int left_inside;
} Line;

/* A boundary met at ray parameter t, which is `at` on the object's line (the sharper of the two from far off). face
 * carries MEMBER_INVERSE where the object lies outside the primitive. */
typedef struct {
    real t, at, slope;
    real err; /* how far off rounding may have put it, if it is met at right angles */
    u32 face;
} Crossing;

/* What the subtraction of the object's centre has rounded away of the ray's origin. */
static inline vec line_lost(const Line* line)
{
    return make_vec(difference_error(line->o.x, line->center.x), difference_error(line->o.y, line->center.y),
                    difference_error(line->o.z, line->center.z));
}

/* The ray in the object's frame. From far off the line's base is its point nearest to the centre, so that the object
 * is seen sharply; else it is the ray's origin itself, so that what lies on a surface stays there. */
static inline Line make_line(const Ray* ray, __global const LayoutObject* object)
{
    Line line;
    line.o = ray->o;
    line.center = load_vec(object->center);
    line.d = ray->d;
    line.excess = ray->excess;
    line.origin = line.base = sub(line.o, line.center);
    line.start = R(0);
    line.err = ray->err;
    line.left = ray->left;
    line.left_inside = ray->left_inside;
    if (dot3(line.origin, line.origin) > square(R(object->near))) {
        /* Wherever rounding puts start, the point there is right: fma subtracts before it rounds. */
        line.start = over_square(dot3(line.origin, line.d), line.excess);
        line.base = add(along(line.origin, line.d, -line.start), line_lost(&line));
    }
    line.size = larger(largest(line.base), R(object->grain));
    return line;
}

#endif
