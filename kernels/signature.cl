/* The entry point that tells paths: one work-item per listed pixel. Built with CLU_SIGNATURE. */
#include "kernels/entry.h"

/* Traces one sample of pixels[item] (column, row; item < count). Its colour goes to colors[item], how many events its
 * path has and their hash to signatures[item], the first `capacity` events to events[item * capacity ...], and the rays
 * that the first `ray_capacity` of them began with to rays[item * ray_capacity * RAY_NUMBERS ...]. */
__kernel void signature(SCENE_PARAMETERS, __global const uint2* restrict pixels, const uint count, const uint sample,
                        const uint capacity, const uint ray_capacity, __global float4* restrict colors,
                        __global uint2* restrict signatures, __global LayoutEvent* restrict events,
                        __global real* restrict rays, __global uint* restrict stats)
{
    const size_t item = get_global_id(0);
    if (item >= count) return;
    World world = SCENE_WORLD;
    world.signature.count = world.signature.hash = 0;
    world.signature.capacity = capacity;
    world.signature.log = events + item * capacity;
    world.signature.ray_capacity = ray_capacity;
    world.signature.rays = rays + item * ray_capacity * RAY_NUMBERS;
    const rgb color = observe(&world, pixels[item].x, pixels[item].y, sample);
    colors[item] = (float4)((float)color.r, (float)color.g, (float)color.b, 0.0f);
    signatures[item] = (uint2)(world.signature.count, world.signature.hash);
    add_statistics(&world, stats, item);
}
