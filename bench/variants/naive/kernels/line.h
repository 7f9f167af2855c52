/* The naive and the re-origined variant: a ray in an object's coordinates. Where it starts, approach.h says. */
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

#include "kernels/approach.h"

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
    approach(&line, object);
    return line;
}

#endif
