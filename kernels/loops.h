/* Whether loops still turn: llvmpipe ends all loops of eight items once they have turned 65535 times together, and says
 * nothing. What comes after may hold anything, and must be no place in memory. A loop of two turns, of which compilers
 * cannot know, then takes one. */
#ifndef CLUCIDA_LOOPS_H
#define CLUCIDA_LOOPS_H

#include "kernels/world.h"

#ifdef CLU_LIMITED_LOOPS
static inline int loops_turn(const World* world)
{
    const u32 turns = world->frame->width ? 2u : 3u;
    u32 x = 1u;
    for (u32 i = 0; i < turns; i++) x = 3u * x + 1u;
    return x >= 13u;
}
#else
#define loops_turn(world) 1
#endif

#endif
