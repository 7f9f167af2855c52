/* What every entry point that traces begins with: the scene's buffers as its first parameters, in the order of
 * LayoutBuffer, and the world made of them. */
#ifndef CLUCIDA_ENTRY_H
#define CLUCIDA_ENTRY_H

#include "kernels/loops.h"
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

/* Adds a work-item's counters to its row of the statistics. */
static inline void add_statistics(const World* world, __global uint* stats, size_t item)
{
    __global uint* counters = stats + item % STAT_SLOTS * STAT_COUNT;
    for (uint k = 0; k < STAT_COUNT; k++)
        if (world->stats[k]) atomic_add(&counters[k], world->stats[k]);
    if (!loops_turn(world)) atomic_inc(&counters[STAT_STUCK]);
}

#endif
