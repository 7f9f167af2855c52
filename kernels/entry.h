/* What every entry point that traces begins with: the scene's buffers as its first parameters, in the order of
 * LayoutBuffer, and the world made of them. */
#ifndef CLUCIDA_ENTRY_H
#define CLUCIDA_ENTRY_H

#include "kernels/observer.h"

/* clang-format off */
#define SCENE_PARAMETERS                                                                                         \
    __global const LayoutFrame* restrict frame, __global const LayoutNode* restrict nodes,                       \
    __global const LayoutObject* restrict objects, __global const LayoutGroup* restrict groups,                  \
    __global const uint* restrict members, __global const uint* restrict programs,                               \
    __global const LayoutPlane* restrict planes, __global const LayoutPlaneBlock* restrict blocks,               \
    __global const LayoutSphere* restrict spheres, __global const LayoutQuadric* restrict quadrics,              \
    __global const LayoutTorus* restrict tori, __global const LayoutOptics* restrict optics,                     \
    __global const LayoutTexture* restrict textures, __global const LayoutImage* restrict images,                \
    __global const uint* restrict texels, __global const LayoutLight* restrict lights

#define SCENE_WORLD                                                                                              \
    {frame,  nodes,    objects, groups, members,  programs, planes, blocks, spheres,                             \
     quadrics, tori,   optics,  textures, images, texels,   lights, {0}}
/* clang-format on */

/* Counts a work-item as stuck whose loops do not turn any more: llvmpipe ends all loops of eight items, once they have
 * turned 65535 times together, and says nothing. A loop of two turns, of which compilers cannot know, then takes one.
 */
#ifdef CLU_LIMITED_LOOPS
static inline void confirm_loops(const World* world, __global uint* stats, size_t item)
{
    const uint turns = world->frame->width ? 2u : 3u;
    uint x = 1u;
    for (uint i = 0; i < turns; i++) x = 3u * x + 1u;
    if (x < 13u) atomic_inc(&stats[item % STAT_SLOTS * STAT_COUNT + STAT_STUCK]);
}
#else
#define confirm_loops(world, stats, item) ((void)0)
#endif

/* Adds a work-item's counters to its row of the statistics. */
static inline void add_statistics(const World* world, __global uint* stats, size_t item)
{
    confirm_loops(world, stats, item);
    __global uint* counters = stats + item % STAT_SLOTS * STAT_COUNT;
    for (uint k = 0; k < STAT_COUNT; k++)
        if (world->stats[k]) atomic_add(&counters[k], world->stats[k]);
}

#endif
