/* The signature of a path: an event for each traced segment, so that paths can be compared and not only colours.
 * Compiled only when asked (CLU_SIGNATURE); else nothing of it is left. */
#ifndef CLUCIDA_SIGNATURE_H
#define CLUCIDA_SIGNATURE_H

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
