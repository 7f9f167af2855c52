/* The rays of a tile that wait, in a work-item's own memory, and the light that has arrived at its pixels. */
#ifndef CLUCIDA_PACKETS_STACKS_H
#define CLUCIDA_PACKETS_STACKS_H

#include "kernels/packets/packet.h"
#include "kernels/packets/tile.h"

#define PIXEL_BITS 8u
#define PIXEL_MASK ((1u << PIXEL_BITS) - 1u)

/* A stack each for rays that begin in the vacuum or in a medium, reflected or refracted: those meet much the same
 * objects. No scene was ever seen to need more than 42 places; one that does is rendered again with more, as when the
 * one-ray kernel's stack is full. */
#define STACKS 4u
#define PACKET_STACK (32u + 4u * CLU_STACK_CAPACITY)

typedef struct {
    u32 count[STACKS];
    real rows[STACKS][ROW_COUNT][PACKET_STACK];
    int ids[STACKS][ID_COUNT][PACKET_STACK];
} PacketStacks;

/* A stack that fills a packet, or STACKS. */
INLINED u32 full_stack(const PacketStacks* stacks)
{
    u32 full = STACKS;
    for (u32 i = 0; i < STACKS; i++)
        if (stacks->count[i] >= LANES) full = i;
    return full;
}

/* The fullest stack, or STACKS if all are empty. */
INLINED u32 fullest_stack(const PacketStacks* stacks)
{
    u32 most = 0, fullest = STACKS;
    for (u32 i = 0; i < STACKS; i++) {
        if (stacks->count[i] <= most) continue;
        most = stacks->count[i];
        fullest = i;
    }
    return fullest;
}

/* The stack's topmost rays. Where there are too few, lanes without a ray have the numbers of one that has. */
INLINED void pop_packet(PacketStacks* stacks, u32 stack, Packet* packet)
{
    const u32 count = stacks->count[stack] < LANES ? stacks->count[stack] : LANES, at = stacks->count[stack] -= count;
    for (u32 i = count; i < LANES; i++) {
        for (u32 row = 0; row < ROW_COUNT; row++) stacks->rows[stack][row][at + i] = stacks->rows[stack][row][at];
        for (u32 id = 0; id < ID_COUNT; id++) stacks->ids[stack][id][at + i] = stacks->ids[stack][id][at];
        stacks->ids[stack][ID_MEDIUM][at + i] = MEDIUM_NO_RAY;
    }
    for (u32 row = 0; row < ROW_COUNT; row++) store_wide(load_lanes(&stacks->rows[stack][row][at]), packet->rows[row]);
    for (u32 id = 0; id < ID_COUNT; id++) store_ids(load_ids(&stacks->ids[stack][id][at]), packet->ids[id]);
}

/* Pushes the packet's rays of the given lanes, each onto its medium's stack. */
INLINED void push_packet(World* world, PacketStacks* stacks, const Packet* packet, u32 lanes, u32 refracted)
{
    for (; lanes; lanes &= lanes - 1u) {
        const u32 i = first_lane(lanes);
        const u32 stack = (packet->ids[ID_MEDIUM][i] == MEDIUM_VACUUM ? 0u : 2u) + refracted;
        const u32 k = stacks->count[stack];
        if (k + LANES > PACKET_STACK) { /* pop_packet may fill up what lies beyond */
            COUNT(world, STAT_STACK_OVERFLOW);
            continue;
        }
        stacks->count[stack] = k + 1;
        for (u32 row = 0; row < ROW_COUNT; row++) stacks->rows[stack][row][k] = packet->rows[row][i];
        for (u32 id = 0; id < ID_COUNT; id++) stacks->ids[stack][id][k] = packet->ids[id][i];
        COUNT(world, STAT_RAYS);
        COUNT(world, refracted ? STAT_REFRACTED : STAT_REFLECTED);
    }
}

typedef struct {
    real sums[PACKET_TILE * PACKET_TILE][3];
} TileLight;

INLINED void add_light(World* world, TileLight* light, int tag, rgb c)
{
    real* sums = light->sums[(u32)tag & PIXEL_MASK];
    if (!(c.r == c.r && c.g == c.g && c.b == c.b)) {
        COUNT(world, STAT_NAN);
        return;
    }
    sums[0] += c.r;
    sums[1] += c.g;
    sums[2] += c.b;
}

#endif
