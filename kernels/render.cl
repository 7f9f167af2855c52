/* The entry point: one work-item per pixel of a tile. */
#include "kernels/entry.h"

/* Adds samples sample_begin .. sample_end-1 of pixel (x0, y0) + the item's number to its place in the tile (or, from
 * sample 0 on, starts it anew); the tile is as wide as the range. */
__kernel void render(SCENE_PARAMETERS, const uint x0, const uint y0, const uint sample_begin, const uint sample_end,
                     __global float4* restrict tile, __global uint* restrict stats)
{
    const uint i = x0 + (uint)get_global_id(0), j = y0 + (uint)get_global_id(1);
    if (i >= frame->width || j >= frame->height) return;
    World world = SCENE_WORLD;
    const size_t place = get_global_id(1) * get_global_size(0) + get_global_id(0);
    float4 sum = sample_begin ? tile[place] : (float4)(0.0f);
    for (uint sample = sample_begin; sample < sample_end; sample++) {
        const rgb color = observe(&world, i, j, sample);
        sum += (float4)((float)color.r, (float)color.g, (float)color.b, 0.0f);
    }
    tile[place] = sum;
    add_statistics(&world, stats, place);
}
