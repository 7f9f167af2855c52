/* The tree over the objects' boxes: nodes of eight children, walked from near to far. */
#ifndef CLUCIDA_TREE_H
#define CLUCIDA_TREE_H

#include "kernels/node.h"
#include "kernels/world.h"

/* A walk along a ray. What waits lies on a stack, the nearest of a node's children on top. */
typedef struct {
    vec o, inverse;             /* the ray's origin; 1/d, finite */
    u32 near_x, near_y, near_z; /* which bounds the ray meets first (LayoutNode); last the others: */
    u32 far_x, far_y, far_z;
    u32 next_root, count;
    u32 refs[CLU_WALK_CAPACITY];
    real near[CLU_WALK_CAPACITY];
} Walk;

/* 1/x, or very much if x is 0: 0 times it must stay 0. */
INLINED real finite_inverse(real x)
{
    return fabs(x) > R(1e-30f) ? R(1) / x : copysign(R(1e30f), x);
}

INLINED void walk_begin(Walk* walk, const Ray* ray)
{
    walk->o = ray->o;
    walk->inverse = make_vec(finite_inverse(ray->d.x), finite_inverse(ray->d.y), finite_inverse(ray->d.z));
    walk->near_x = ray->d.x < R(0) ? 3u : 0u;
    walk->near_y = ray->d.y < R(0) ? 4u : 1u;
    walk->near_z = ray->d.z < R(0) ? 5u : 2u;
    walk->far_x = 3u - walk->near_x;
    walk->far_y = 5u - walk->near_y;
    walk->far_z = 7u - walk->near_z;
    walk->next_root = walk->count = 0;
}

/* Where the ray reaches eight bounds of one axis. The bounds and o are exact, so this is right to three roundings. */
INLINED wide reach(wide bounds, real o, real inverse)
{
    return (bounds - wide_all(o)) * wide_all(inverse);
}

/* A benchmark counts the nodes that are opened, once for each ray. */
#ifndef NODE_OPENED
#define NODE_OPENED(world, rays) ((void)0)
#endif

/* Puts the node's children that are met between from and to onto the stack, sorted down to base. */
INLINED void walk_open(Walk* walk, __global const LayoutNode* node, real from, real to, u32 base)
{
    const wide near_x = reach(node_bounds(node, walk->near_x), walk->o.x, walk->inverse.x);
    const wide near_y = reach(node_bounds(node, walk->near_y), walk->o.y, walk->inverse.y);
    const wide near_z = reach(node_bounds(node, walk->near_z), walk->o.z, walk->inverse.z);
    const wide far_x = reach(node_bounds(node, walk->far_x), walk->o.x, walk->inverse.x);
    const wide far_y = reach(node_bounds(node, walk->far_y), walk->o.y, walk->inverse.y);
    const wide far_z = reach(node_bounds(node, walk->far_z), walk->o.z, walk->inverse.z);
    const wide near = wide_larger(wide_larger(near_x, near_y), wide_larger(near_z, wide_all(from)));
    const wide far = wide_smaller(wide_smaller(far_x, far_y), far_z) * wide_all(R(1) + R(8) * UNIT_ROUNDOFF);
    u32 bits = wide_bits(near <= wide_smaller(far, wide_all(to)));
    real lanes[LANES];
    store_wide(near, lanes);
    for (; bits; bits &= bits - 1u) {
        const u32 lane = first_lane(bits);
        u32 i = walk->count++;
        for (; i > base && walk->near[i - 1] < lanes[lane]; i--) {
            walk->near[i] = walk->near[i - 1];
            walk->refs[i] = walk->refs[i - 1];
        }
        walk->near[i] = lanes[lane];
        walk->refs[i] = node->child[lane];
    }
}

/* The next object whose box is met between ray parameters from and to, or WALK_DONE. */
#define WALK_DONE 0xffffffffu
static CALLED u32 walk_on(Walk* walk, const World* world, real from, real to)
{
    __global const LayoutFrame* frame = world->frame;
    for (;;) {
        /* A root while there is room for all that it can bring; else what waits. */
        u32 node, base = 0;
        if (walk->next_root < frame->root_count &&
            (walk->count == 0 || walk->count + frame->walk_reserve + LANES <= CLU_WALK_CAPACITY)) {
            node = walk->next_root++;
        } else {
            if (walk->count == 0) return WALK_DONE;
            walk->count--;
            if (!(walk->near[walk->count] <= to)) continue;
            const u32 ref = walk->refs[walk->count];
            if (!(ref & NODE_INNER)) return ref;
            node = ref & ~NODE_INNER;
            base = walk->count;
        }
        NODE_OPENED(world, 1u);
        walk_open(walk, &world->nodes[node], from, to, base);
    }
}

#ifdef CLU_LIMITED_LOOPS
/* Where its loop was ended it has come to anything (loops.h). */
static inline u32 walk_next(Walk* walk, const World* world, real from, real to)
{
    const u32 id = walk_on(walk, world, from, to);
    return id < world->frame->object_count ? id : WALK_DONE;
}
#else
#define walk_next walk_on
#endif

#endif
