/* The objects that a packet's rays may meet: a list of few, or the tree over many, walked by all rays together. */
#ifndef CLUCIDA_PACKETS_WALK_H
#define CLUCIDA_PACKETS_WALK_H

#include "kernels/packets/lanes.h"
#include "kernels/tree.h"

typedef struct {
    wide_vec o, inverse;                          /* the rays' origins; 1/d, finite */
    real o_lanes[3][LANES], over_lanes[3][LANES]; /* of a tree, the same lane by lane */
    u32 next, last;                               /* an object of the list or a root */
    u32 count;                                    /* what waits, the nearest on top: */
    u32 refs[CLU_WALK_CAPACITY], rays[CLU_WALK_CAPACITY];
    real near[CLU_WALK_CAPACITY]; /* of the nearest ray */
} PacketWalk;

INLINED int is_list(const World* world)
{
    return world->frame->object_count <= LIST_CAPACITY;
}

INLINED wide wide_finite_inverse(wide x)
{
    const wide least = wide_all(R(1e-30f)), inverse = wide_all(R(1)) / where(wide_fabs(x) > least, x, least);
    return where((x < wide_all(R(0))) & (inverse > wide_all(R(0))), -inverse, inverse);
}

INLINED void packet_walk_begin(PacketWalk* walk, const World* world, wide_vec o, wide_vec d)
{
    walk->next = walk->count = 0;
    walk->last = is_list(world) ? world->frame->object_count : world->frame->root_count;
    walk->o = o;
    walk->inverse = make_wide_vec(wide_finite_inverse(d.x), wide_finite_inverse(d.y), wide_finite_inverse(d.z));
    if (is_list(world)) return;
    store_wide(o.x, walk->o_lanes[0]);
    store_wide(o.y, walk->o_lanes[1]);
    store_wide(o.z, walk->o_lanes[2]);
    store_wide(walk->inverse.x, walk->over_lanes[0]);
    store_wide(walk->inverse.y, walk->over_lanes[1]);
    store_wide(walk->inverse.z, walk->over_lanes[2]);
}

INLINED void box_axis(real least, real most, wide o, wide inverse, wide* near, wide* far)
{
    const wide a = (wide_all(least) - o) * inverse, b = (wide_all(most) - o) * inverse;
    *near = wide_larger(*near, wide_smaller(a, b));
    *far = wide_smaller(*far, wide_larger(a, b));
}

/* Which of the rays meet the box of the object that the list gave last, between ray parameters from and to. */
INLINED wide_mask packet_meets_box(const PacketWalk* walk, const World* world, wide from, wide to)
{
    if (!is_list(world)) return all_ids(-1);
    __global const LayoutNode* node = &world->nodes[(walk->next - 1u) / LANES];
    const u32 k = (walk->next - 1u) % LANES;
    wide near = from, far = wide_all(INFINITE);
    box_axis(node_bound(node, 0, k), node_bound(node, 3, k), walk->o.x, walk->inverse.x, &near, &far);
    box_axis(node_bound(node, 1, k), node_bound(node, 4, k), walk->o.y, walk->inverse.y, &near, &far);
    box_axis(node_bound(node, 2, k), node_bound(node, 5, k), walk->o.z, walk->inverse.z, &near, &far);
    return near <= wide_smaller(far * (R(1) + R(8) * UNIT_ROUNDOFF), to);
}

/* Puts the node's children that one of the rays meets between from and to onto the stack, sorted down to base. */
INLINED void packet_walk_open(PacketWalk* walk, __global const LayoutNode* node, u32 rays, const real from[LANES],
                              const real to[LANES], u32 base)
{
    wide nearest = wide_all(INFINITE);
    real nearest_lanes[LANES];
    u64 met = 0; /* a byte for each ray, of the children that it meets */
    for (; rays; rays &= rays - 1u) {
        const u32 k = first_lane(rays);
        const real ix = walk->over_lanes[0][k], iy = walk->over_lanes[1][k], iz = walk->over_lanes[2][k];
        const real ox = walk->o_lanes[0][k], oy = walk->o_lanes[1][k], oz = walk->o_lanes[2][k];
        const u32 x = ix < R(0) ? 3u : 0u, y = iy < R(0) ? 4u : 1u, z = iz < R(0) ? 5u : 2u;
        const wide near =
            wide_larger(wide_larger(reach(node_bounds(node, x), ox, ix), reach(node_bounds(node, y), oy, iy)),
                        wide_larger(reach(node_bounds(node, z), oz, iz), wide_all(from[k])));
        const wide far = wide_smaller(wide_smaller(reach(node_bounds(node, 3u - x), ox, ix),
                                                   reach(node_bounds(node, 5u - y), oy, iy)),
                                      reach(node_bounds(node, 7u - z), oz, iz)) *
                         wide_all(R(1) + R(8) * UNIT_ROUNDOFF);
        const wide_mask hit = near <= wide_smaller(far, wide_all(to[k]));
        nearest = where(hit, wide_smaller(near, nearest), nearest);
        met |= (u64)wide_bits(hit) << (8u * k);
    }
    if (!met) return;
    store_wide(nearest, nearest_lanes);
    for (u32 some = wide_bits(nearest < wide_all(INFINITE)); some; some &= some - 1u) {
        const u32 child = first_lane(some);
        /* The child's bit of all bytes, side by side. */
        const u64 bits = met >> child & 0x0101010101010101ul;
        u32 i = walk->count++;
        for (; i > base && walk->near[i - 1] < nearest_lanes[child]; i--) {
            walk->near[i] = walk->near[i - 1];
            walk->refs[i] = walk->refs[i - 1];
            walk->rays[i] = walk->rays[i - 1];
        }
        walk->near[i] = nearest_lanes[child];
        walk->refs[i] = node->child[child];
        walk->rays[i] = (u32)(bits * 0x0102040810204080ul >> 56);
    }
}

/* The next object whose box one of the rays meets between ray parameters from and to, or WALK_DONE; those rays. */
static CALLED u32 packet_tree_next(PacketWalk* walk, const World* world, wide from, wide to, u32* rays)
{
    __global const LayoutFrame* frame = world->frame;
    real from_lanes[LANES], to_lanes[LANES];
    store_wide(from, from_lanes);
    store_wide(to, to_lanes);
    for (;;) {
        u32 node, base = 0, its_rays = 255u;
        if (walk->next < walk->last &&
            (walk->count == 0 || walk->count + frame->walk_reserve + LANES <= CLU_WALK_CAPACITY)) {
            node = walk->next++;
        } else {
            if (walk->count == 0) return WALK_DONE;
            walk->count--;
            its_rays = walk->rays[walk->count] & wide_bits(wide_all(walk->near[walk->count]) <= to);
            if (!its_rays) continue;
            const u32 ref = walk->refs[walk->count];
            if (!(ref & NODE_INNER)) {
                *rays = its_rays;
                return ref;
            }
            node = ref & ~NODE_INNER;
            base = walk->count;
        }
        NODE_OPENED(world, count_bits(its_rays));
        packet_walk_open(walk, &world->nodes[node], its_rays, from_lanes, to_lanes, base);
    }
}

INLINED u32 packet_walk_next(PacketWalk* walk, const World* world, wide from, wide to, wide_mask* rays)
{
    if (is_list(world)) {
        if (walk->next == walk->last) return WALK_DONE;
        const u32 i = walk->next++;
        *rays = all_ids(-1);
        return world->nodes[i / LANES].child[i % LANES];
    }
    u32 bits = 0;
    const u32 id = packet_tree_next(walk, world, from, to, &bits);
    *rays = rays_mask(bits);
    return id;
}

#endif
