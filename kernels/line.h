/* A ray as an object sees it, and a boundary that it meets. */
#ifndef CLUCIDA_LINE_H
#define CLUCIDA_LINE_H

#include "kernels/world.h"

typedef struct {
    vec base, d; /* base relative to the object's centre */
    vec origin;  /* the ray's origin, relative to the centre too */
    vec lost;    /* what the subtraction of the centre has rounded away of origin */
    real start;  /* parameter of the ray's origin */
    real err;    /* of the origin: Ray's */
    real dd;     /* |d|^2 */
    real grain;  /* the object's */
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

/* The ray in the object's frame. From far off the line's base is its point nearest to the centre, so that the object
 * is seen sharply; else it is the ray's origin itself, so that what lies on a surface stays there. */
static inline Line make_line(const Ray* ray, __global const LayoutObject* object)
{
    const vec center = load_vec(object->center);
    Line line;
    line.d = ray->d;
    line.dd = ray->dd;
    line.origin = line.base = sub(ray->o, center);
    line.lost = make_vec(difference_error(ray->o.x, center.x), difference_error(ray->o.y, center.y),
                         difference_error(ray->o.z, center.z));
    line.start = R(0);
    line.err = ray->err;
    line.grain = R(object->grain);
    line.left = ray->left;
    line.left_inside = ray->left_inside;
    if (dot3(line.origin, line.origin) > square(R(object->near))) {
        /* Wherever rounding puts start, the point there is right: fma subtracts before it rounds. */
        line.start = dot3(line.origin, ray->d) / line.dd;
        line.base = add(along(line.origin, ray->d, -line.start), line.lost);
    }
    return line;
}

#endif
