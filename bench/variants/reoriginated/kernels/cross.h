/* The re-origined variant: a cross product as textbooks have it. */
#ifndef CLUCIDA_CROSS_H
#define CLUCIDA_CROSS_H

#include "kernels/vec.h"

static inline vec cross3(vec a, vec b)
{
    return make_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

#endif
