/* The re-origined variant: from far off a ray in an object's coordinates starts at its point nearest to the centre. */
#ifndef CLUCIDA_LINE_H
#define CLUCIDA_LINE_H

#include "kernels/world.h"

typedef struct {
    vec base, d;
    vec origin;
    real start;
    real err;
    real excess;
    u32 left;
    int left_inside;
} Line;

typedef struct {
    real t, at, slope;
    real err;
    u32 face;
} Crossing;

static inline Line make_line(const Ray* ray, __global const LayoutObject* object)
{
    Line line;
    line.origin = line.base = sub(ray->o, load_vec(object->center));
    line.d = ray->d;
    line.start = R(0);
    line.err = R(0);
    line.excess = ray->excess;
    line.left = ray->left;
    line.left_inside = ray->left_inside;
    if (dot3(line.origin, line.origin) > square(R(object->near))) {
        line.start = dot3(line.origin, ray->d) / dot3(ray->d, ray->d);
        line.base = along(line.origin, ray->d, -line.start);
    }
    return line;
}

#endif
