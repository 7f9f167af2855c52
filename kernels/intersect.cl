/* The entry point that tells single intersections: one work-item follows the ray of each listed pixel from surface to
 * surface and notes every ray with what it met. */
#include "kernels/entry.h"

static inline void note_vec(__global real* to, vec v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

/* Of each of `steps` rays an item writes 9 numbers (origin and direction, the point that was met; relative to the eye)
 * and 3 marks (1: nothing met, 2: met; the object; the primitive). At a surface it goes on straight ahead or reflected
 * by turns that the item's number decides; after a miss nothing more is written. */
__kernel void intersect(SCENE_PARAMETERS, __global const uint2* restrict pixels, const uint count, const uint steps,
                        __global real* restrict numbers, __global uint* restrict marks)
{
    const size_t item = get_global_id(0);
    if (item >= count) return;
    World world = SCENE_WORLD;
    Branch branch;
    observer_branch(&world, pixels[item].x, pixels[item].y, 0, &branch);
    Ray ray = branch.ray;
    for (uint step = 0; step < steps; step++) {
        __global real* at = numbers + 9 * (item * steps + step);
        __global uint* mark = marks + 3 * (item * steps + step);
        Surface s;
        note_vec(at, ray.o);
        note_vec(at + 3, ray.d);
        mark[0] = 1;
        if (!next_surface(&world, &ray, branch.medium, &s)) return;
        note_vec(at + 6, s.p);
        mark[0] = 2;
        mark[1] = s.object;
        mark[2] = s.left;
        const int straight = (int)((pixels[item].x + pixels[item].y * 3u) >> (step % 3u) & 1u);
        if (straight)
            branch.medium = s.after;
        else
            ray.d = reflected(ray.d, s.facing, s.cosine);
        ray.o = s.p;
        ray.excess = length_excess(ray.d);
        ray.left = s.left;
        ray.left_inside = straight ? s.beyond_inside : !s.beyond_inside;
        ray.err = s.err;
    }
}
