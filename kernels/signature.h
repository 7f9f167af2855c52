/* The signature of a path: an event for each traced segment, so that paths can be compared and not only colours.
 * Compiled only when asked (CLU_SIGNATURE); else nothing of it is left. */
#ifndef CLUCIDA_SIGNATURE_H
#define CLUCIDA_SIGNATURE_H

#include "kernels/color.h"
#include "kernels/world.h"

#ifdef CLU_SIGNATURE
/* One step of a hash over 32-bit words (the finalizer of MurmurHash3, A. Appleby, chained). */
static inline u32 hash_word(u32 hash, u32 word)
{
    hash = (hash ^ word) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}
#endif

/* Notes, while there is room, the ray of the segment whose event comes next, and the throughput that it starts with. */
static inline void record_ray(World* world, const Ray* ray, rgb throughput)
{
#ifdef CLU_SIGNATURE
    const Signature* s = &world->signature;
    if (s->count >= s->ray_capacity) return;
    __global real* at = s->rays + (size_t)s->count * RAY_NUMBERS;
    at[0] = ray->o.x;
    at[1] = ray->o.y;
    at[2] = ray->o.z;
    at[3] = ray->d.x;
    at[4] = ray->d.y;
    at[5] = ray->d.z;
    at[6] = throughput.r;
    at[7] = throughput.g;
    at[8] = throughput.b;
#else
    (void)world;
    (void)ray;
    (void)throughput;
#endif
}

/* Notes the event: counts it, adds it to the hash and, while there is room, to the log. */
static inline void record_event(World* world, LayoutEvent event)
{
#ifdef CLU_SIGNATURE
    Signature* s = &world->signature;
    const u32 place = hash_word(hash_word(event.hop, event.object), event.face);
    s->hash = hash_word(s->hash, hash_word(hash_word(place, event.what), event.lights));
    if (s->count < s->capacity) s->log[s->count] = event;
    s->count++;
#else
    (void)world;
    (void)event;
#endif
}

#endif
