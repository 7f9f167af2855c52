/* The entry point that tells paths: one work-item per listed pixel. Built with CLU_SIGNATURE. */
#include "kernels/entry.h"

/* Traces one sample of pixels[item] (column, row; item < count). Its colour goes to colors[item], how many events its
 * path has and their hash to signatures[item], and the first `capacity` events to events[item * capacity ...]. */
__kernel void signature(SCENE_PARAMETERS, __global const uint2* restrict pixels, const uint count, const uint sample,
                        const uint capacity, __global float4* restrict colors, __global uint2* restrict signatures,
                        __global LayoutEvent* restrict events, __global uint* restrict stats)
{
    const size_t item = get_global_id(0);
    if (item >= count) return;
    World world = SCENE_WORLD;
    world.signature.count = world.signature.hash = 0;
    world.signature.capacity = capacity;
    world.signature.log = events + item * capacity;
    const rgb color = observe(&world, pixels[item].x, pixels[item].y, sample);
    colors[item] = (float4)((float)color.r, (float)color.g, (float)color.b, 0.0f);
    signatures[item] = (uint2)(world.signature.count, world.signature.hash);
    add_statistics(&world, stats, item);
}
