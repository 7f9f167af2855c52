/* The re-origined variant: from far off rays in an object's coordinates start at their points nearest to the centre. */
#ifndef CLUCIDA_PACKETS_APPROACH_H
#define CLUCIDA_PACKETS_APPROACH_H

INLINED void wide_approach(WideLine* l, __global const LayoutObject* object)
{
    const wide_mask far = wide_dot(l->origin, l->origin) > wide_all(square(R(object->near)));
    if (!any_lane(far)) return;
    l->start = where(far, wide_dot(l->origin, l->d) / wide_dot(l->d, l->d), l->start);
    l->base = wide_along(l->origin, l->d, -l->start);
}

#endif
