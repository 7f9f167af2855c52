/* The re-origined variant: from far off a ray in an object's coordinates starts at its point nearest to the centre. */
#ifndef CLUCIDA_APPROACH_H
#define CLUCIDA_APPROACH_H

static inline void approach(Line* line, __global const LayoutObject* object)
{
    if (dot3(line->origin, line->origin) > square(R(object->near))) {
        line->start = dot3(line->origin, line->d) / dot3(line->d, line->d);
        line->base = along(line->origin, line->d, -line->start);
    }
}

#endif
