/* The interior: the set of objects that hold the ray, as ascending ids. The first is the medium in force. */
#ifndef CLUCIDA_INTERIOR_H
#define CLUCIDA_INTERIOR_H

#include "kernels/world.h"

typedef struct {
    u32 count;
    u32 ids[CLU_INTERIOR_CAPACITY];
} Interior;

INLINED u32 medium_of(const Interior* interior)
{
    return interior->count ? interior->ids[0] : VACUUM;
}

INLINED int interior_has(const Interior* interior, u32 id)
{
    for (u32 i = 0; i < interior->count; i++)
        if (interior->ids[i] == id) return 1;
    return 0;
}

INLINED void interior_copy(Interior* to, const Interior* from)
{
    to->count = from->count;
    for (u32 i = 0; i < from->count; i++) to->ids[i] = from->ids[i];
}

/* Enter the object, or leave it if the ray is inside. */
INLINED void interior_toggle(World* world, Interior* interior, u32 id)
{
    u32 i = 0;
    while (i < interior->count && interior->ids[i] < id) i++;
    if (i < interior->count && interior->ids[i] == id) {
        interior->count--;
        for (; i < interior->count; i++) interior->ids[i] = interior->ids[i + 1];
        return;
    }
    if (interior->count == CLU_INTERIOR_CAPACITY) {
        COUNT(world, STAT_INTERIOR_OVERFLOW);
        return;
    }
    for (u32 j = interior->count; j > i; j--) interior->ids[j] = interior->ids[j - 1];
    interior->ids[i] = id;
    interior->count++;
}

#endif
