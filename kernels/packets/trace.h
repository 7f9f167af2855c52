/* A tile's pixels by packets of rays: one work-item traces them all. Rays wait on stacks; whenever one of these holds
 * eight they are searched and shaded as a packet, and what they lead to is pushed; else eight new ones of the observer
 * come in. A lane's result does not depend on its neighbours. */
#ifndef CLUCIDA_PACKETS_TRACE_H
#define CLUCIDA_PACKETS_TRACE_H

#include "kernels/observer.h"
#include "kernels/packets/shade.h"

/* The bits of even places, side by side. */
INLINED u32 even_bits(u32 m)
{
    m &= 0x55555555u;
    m = (m | m >> 1) & 0x33333333u;
    m = (m | m >> 2) & 0x0f0f0f0fu;
    return (m | m >> 4) & 0x00ff00ffu;
}

/* A block of pixels of the picture, PACKET_TILE on a side or less at its edges. */
typedef struct {
    u32 x, y, width, height;
} PixelBlock;

/* The media that the rays of `some` start in. */
INLINED void find_starts(World* world, wide_mask some, Packet* packet)
{
    PacketLine l = packet_rays(packet);
    PacketHit hit;
    hit.t = wide_all(R(0));
    hit.after = all_ids(MEDIUM_VACUUM);
    hit.sure = some;
    hit.tied = all_ids(0);
    hit.spread = wide_all(R(0));
    packet_look_beyond(world, packet, all_ids(MEDIUM_NO_RAY), some, &l, &hit);
    store_ids(where_id(some, hit.after, all_ids(MEDIUM_NO_RAY)), packet->ids[ID_MEDIUM]);
    for (u32 unsure = wide_bits(some & ~hit.sure); unsure; unsure &= unsure - 1u) {
        const u32 i = first_lane(unsure);
        const Ray ray = lane_ray(packet, i);
        World copy = *world;
        packet->ids[ID_MEDIUM][i] = signed_medium(full_medium_at_start(&copy, &ray));
    }
}

/* Ends the rays that start in an opaque medium, which are black by rule, and counts the others. */
INLINED void begin_rays(World* world, Packet* packet, wide_mask some)
{
    const wide_id medium = load_ids(packet->ids[ID_MEDIUM]);
    for (u32 within = wide_bits(some & (medium != all_ids(MEDIUM_VACUUM))); within; within &= within - 1u) {
        const u32 i = first_lane(within);
        if (index_of(world, (u32)packet->ids[ID_MEDIUM][i]) == R(0)) packet->ids[ID_MEDIUM][i] = MEDIUM_NO_RAY;
    }
    const u32 count = count_bits(wide_bits(load_ids(packet->ids[ID_MEDIUM]) != all_ids(MEDIUM_NO_RAY)));
    world->stats[STAT_RAYS] += count;
    world->stats[STAT_PRIMARY] += count;
}

/* The observer's rays through eight of the block's pixels, from a place in Morton's order on: four by two pixels. */
INLINED void observe_packet(World* world, const PixelBlock* block, u32 place, u32 sample, Packet* packet)
{
    __global const LayoutFrame* f = world->frame;
    const int right[LANES] = {0, 1, 0, 1, 2, 3, 2, 3}, below[LANES] = {0, 0, 1, 1, 0, 0, 1, 1};
    const wide_id i = load_ids(right) + all_ids((int)even_bits(place));
    const wide_id j = load_ids(below) + all_ids((int)even_bits(place >> 1));
    real a, b;
    sample_offset(sample, f->corner, &a, &b);
    const wide u = (wide_of_ids(i + all_ids((int)block->x)) - R(0.5f) * R(f->width) + a) / R(f->width);
    const wide v = (wide_of_ids(j + all_ids((int)block->y)) - R(0.5f) * R(f->height) + b) / R(f->height);
    const wide_mask some = (i < all_ids((int)block->width)) & (j < all_ids((int)block->height));
    const wide_vec s = make_wide_vec(R(f->column[0]) * u + R(f->row[0]) * v, R(f->column[1]) * u + R(f->row[1]) * v,
                                     R(f->column[2]) * u + R(f->row[2]) * v);
    const wide_vec d = wide_unit(make_wide_vec(R(f->forward[0]) + s.x, R(f->forward[1]) + s.y, R(f->forward[2]) + s.z));
    put_vec(packet, ROW_O, wide_scaled(s, wide_all(R(f->window))));
    put_vec(packet, ROW_D, d);
    store_wide(wide_length_excess(d), packet->rows[ROW_EXCESS]);
    store_wide(wide_all(R(0)), packet->rows[ROW_ERR]);
    for (u32 row = ROW_THROUGHPUT; row < ROW_COUNT; row++) store_wide(wide_all(R(1)), packet->rows[row]);
    store_ids(all_ids((int)MEMBER_NONE), packet->ids[ID_LEFT]);
    store_ids(all_ids(0), packet->ids[ID_LEFT_INSIDE]);
    store_ids(where_id(some, all_ids(MEDIUM_VACUUM), all_ids(MEDIUM_NO_RAY)), packet->ids[ID_MEDIUM]);
    store_ids(j * all_ids((int)PACKET_TILE) + i + all_ids((int)(f->max_hops << PIXEL_BITS)), packet->ids[ID_TAG]);
    if (f->start_count) find_starts(world, some, packet);
    begin_rays(world, packet, some);
}

INLINED void trace_packet(World* world, PacketStacks* stacks, const Packet* packet, TileLight* light)
{
    const wide_id medium = load_ids(packet->ids[ID_MEDIUM]);
    const wide_mask some = medium != all_ids(MEDIUM_NO_RAY);
    if (!any_lane(some)) return;
    count_lanes(world, STAT_QUERIES, some);
    PacketSurfaces surfaces;
    packet_surfaces(world, packet, &surfaces);
    shade_packet(world, stacks, packet, &surfaces, light);
}

/* Samples sample_begin..sample_end-1 of all pixels of the block. */
INLINED void trace_block(World* world, const PixelBlock* block, u32 sample_begin, u32 sample_end, TileLight* light)
{
    PacketStacks stacks;
    const u32 pixels = PACKET_TILE * PACKET_TILE, last = sample_end * pixels;
    for (u32 i = 0; i < STACKS; i++) stacks.count[i] = 0;
    for (u32 i = 0; i < pixels; i++) light->sums[i][0] = light->sums[i][1] = light->sums[i][2] = R(0);
    for (u32 next = sample_begin * pixels;;) {
        Packet packet;
        u32 stack = full_stack(&stacks);
        if (stack == STACKS && next < last) {
            observe_packet(world, block, next % pixels, next / pixels, &packet);
            next += LANES;
        } else {
            if (stack == STACKS) stack = fullest_stack(&stacks);
            if (stack == STACKS) return;
            pop_packet(&stacks, stack, &packet);
        }
        trace_packet(world, &stacks, &packet, light);
    }
}

#endif
