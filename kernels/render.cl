/* The entry point: one work-item per pixel of a tile. */
#include "kernels/observer.h"

/* Adds samples sample_begin .. sample_end-1 of pixel (x0, y0) + the item's number to its place in the tile (or, from
 * sample 0 on, starts it anew); the tile is as wide as the range. */
__kernel void render(__global const LayoutFrame* restrict frame, __global const LayoutObject* restrict objects,
                     __global const LayoutGroup* restrict groups, __global const uint* restrict members,
                     __global const uint* restrict programs, __global const LayoutPlane* restrict planes,
                     __global const LayoutSphere* restrict spheres, __global const LayoutQuadric* restrict quadrics,
                     __global const LayoutTorus* restrict tori, __global const LayoutOptics* restrict optics,
                     __global const LayoutTexture* restrict textures, __global const LayoutImage* restrict images,
                     __global const uint* restrict texels, __global const LayoutLight* restrict lights,
                     __global const uint* restrict starts, const uint x0, const uint y0, const uint sample_begin,
                     const uint sample_end, __global float4* restrict tile, __global uint* restrict stats)
{
    const uint i = x0 + (uint)get_global_id(0), j = y0 + (uint)get_global_id(1);
    if (i >= frame->width || j >= frame->height) return;
    World world = {frame, objects, groups,   members, programs, planes, spheres, quadrics,
                   tori,  optics,  textures, images,  texels,   lights, starts,  {0}};
    const size_t place = get_global_id(1) * get_global_size(0) + get_global_id(0);
    float4 sum = sample_begin ? tile[place] : (float4)(0.0f);
    for (uint sample = sample_begin; sample < sample_end; sample++) {
        const rgb color = observe(&world, i, j, sample);
        sum += (float4)((float)color.r, (float)color.g, (float)color.b, 0.0f);
    }
    tile[place] = sum;
    __global uint* counters = stats + place % STAT_SLOTS * STAT_COUNT;
    for (uint k = 0; k < STAT_COUNT; k++)
        if (world.stats[k]) atomic_add(&counters[k], world.stats[k]);
}
