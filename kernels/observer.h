/* The observer: where the rays of a pixel start and where they go. */
#ifndef CLUCIDA_OBSERVER_H
#define CLUCIDA_OBSERVER_H

#include "kernels/trace.h"

/* Offset of sample i within the pixel, 0..1: the first lies in the middle, the rest follow the R2 sequence (the
 * plastic number's; M. Roberts 2018), in 32-bit fixed point so that it is the same everywhere. */
INLINED void sample_offset(u32 i, u32 corner, real* a, real* b)
{
    const u32 start = corner ? 0u : 0x80000000u;
    *a = R(start + i * 3242174889u) / R(4294967296.0f);
    *b = R(start + i * 2447445414u) / R(4294967296.0f);
}

/* The first object that holds the ray's start. */
static CALLED u32 full_medium_at_start(World* world, const Ray* ray)
{
    u32 medium = VACUUM;
    Walk walk;
    walk_begin(&walk, ray);
    for (;;) {
        const u32 id = walk_next(&walk, world, R(0), R(0));
        if (id == WALK_DONE) return medium;
        if (id >= medium) continue;
        const Line line = make_line(ray, &world->objects[id]);
        if (object_holds_start(world, &world->objects[id], &line)) medium = id;
    }
}

INLINED u32 medium_at_start(World* world, const Ray* ray)
{
    u32 medium;
    return quick_medium(world, ray, R(0), VACUUM, 0, &medium) ? medium : full_medium_at_start(world, ray);
}

/* The ray through pixel (i, j), and the medium of its start. */
INLINED void observer_branch(World* world, u32 i, u32 j, u32 sample, Branch* branch)
{
    __global const LayoutFrame* f = world->frame;
    real a, b;
    sample_offset(sample, f->corner, &a, &b);
    const real u = (R(i) - R(0.5f) * R(f->width) + a) / R(f->width);
    const real v = (R(j) - R(0.5f) * R(f->height) + b) / R(f->height);
    const vec s = add(scaled(load_vec(f->column), u), scaled(load_vec(f->row), v));
    branch->ray.o = scaled(s, R(f->window));
    branch->ray.d = unit(add(load_vec(f->forward), s));
    branch->ray.excess = length_excess(branch->ray.d);
    branch->ray.left = MEMBER_NONE;
    branch->ray.left_inside = 0;
    branch->ray.err = R(0);
    branch->throughput = branch->weight = grey(R(1));
    branch->hops = f->max_hops;
    branch->medium = f->start_count ? medium_at_start(world, &branch->ray) : VACUUM;
}

/* One sample of a pixel: linear light. */
INLINED rgb observe(World* world, u32 i, u32 j, u32 sample)
{
    Branch branch;
    observer_branch(world, i, j, sample, &branch);
    const rgb color = trace(world, &branch);
    if (color.r == color.r && color.g == color.g && color.b == color.b) return color;
    COUNT(world, STAT_NAN);
    return grey(R(0));
}

#endif
