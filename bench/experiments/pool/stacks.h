/* The rays of a tile that wait, in a work-item's own memory, and the light that has arrived at its pixels. */
#ifndef POOL_STACKS_H
#define POOL_STACKS_H

#include "kernels/color.h"
#include "kernels/packet.h"

/* What is kept of a ray. */
enum Row {
    ROW_OX,
    ROW_OY,
    ROW_OZ,
    ROW_DX,
    ROW_DY,
    ROW_DZ,
    ROW_EXCESS,
    ROW_ERR,
    ROW_LEFT,        /* bits of a reference */
    ROW_LEFT_INSIDE, /* a mask */
    ROW_MEDIUM,      /* bits of an id or MEDIUM_* */
    ROW_TAG,         /* the pixel's number within the tile | segments left << PIXEL_BITS */
    ROW_THROUGHPUT,  /* red, green, blue */
    ROW_WEIGHT = ROW_THROUGHPUT + 3,
    ROW_COUNT = ROW_WEIGHT + 3
};

#define TILE 32u
#define PIXEL_BITS 10u
#define PIXEL_MASK ((1u << PIXEL_BITS) - 1u)

/* A stack each for rays that begin in the vacuum or in a medium, reflected or refracted: those meet much the same
 * objects. Of 8 lanes no stack was ever seen to hold more than 42 rays, of 16 no more than 84. */
#define STACKS 4u
#define STACK_CAPACITY 128u

typedef struct {
    u32 count[STACKS];
    float rows[STACKS][ROW_COUNT][STACK_CAPACITY];
} Stacks;

typedef struct {
    float row[ROW_COUNT][POOL_WIDTH];
} Packet;

INLINED vvec packet_vec(const Packet* packet, u32 row)
{
    vvec v;
    v.x = LOAD(0, packet->row[row]);
    v.y = LOAD(0, packet->row[row + 1]);
    v.z = LOAD(0, packet->row[row + 2]);
    return v;
}
INLINED void put_vec(Packet* packet, u32 row, vvec v)
{
    STORE(v.x, 0, packet->row[row]);
    STORE(v.y, 0, packet->row[row + 1]);
    STORE(v.z, 0, packet->row[row + 2]);
}
INLINED rgb lane_color(const Packet* packet, u32 row, u32 lane)
{
    return make_rgb(packet->row[row][lane], packet->row[row + 1][lane], packet->row[row + 2][lane]);
}
INLINED int has_ray(const Packet* packet, u32 lane)
{
    return as_int(packet->row[ROW_MEDIUM][lane]) != MEDIUM_NO_RAY;
}
INLINED u32 as_medium(u32 id)
{
    return id == VACUUM ? (u32)MEDIUM_VACUUM : id;
}
INLINED u32 lane_medium(const Packet* packet, u32 lane)
{
    const u32 medium = as_uint(packet->row[ROW_MEDIUM][lane]);
    return medium == (u32)MEDIUM_VACUUM ? VACUUM : medium;
}

/* A stack that fills a packet, or STACKS. */
INLINED u32 full_stack(const Stacks* stacks)
{
    u32 full = STACKS;
    for (u32 i = 0; i < STACKS; i++)
        if (stacks->count[i] >= POOL_WIDTH) full = i;
    return full;
}

/* The fullest stack, or STACKS if all are empty. */
INLINED u32 fullest_stack(const Stacks* stacks)
{
    u32 most = 0, fullest = STACKS;
    for (u32 i = 0; i < STACKS; i++) {
        if (stacks->count[i] <= most) continue;
        most = stacks->count[i];
        fullest = i;
    }
    return fullest;
}

/* The stack's topmost rays. */
INLINED void pop_packet(Stacks* stacks, u32 stack, Packet* packet)
{
    const u32 count = min(stacks->count[stack], (u32)POOL_WIDTH), at = stacks->count[stack] -= count;
    for (u32 row = 0; row < ROW_COUNT; row++) STORE(LOAD(0, &stacks->rows[stack][row][at]), 0, packet->row[row]);
    for (u32 i = count; i < POOL_WIDTH; i++) packet->row[ROW_MEDIUM][i] = as_float(MEDIUM_NO_RAY);
}

/* Pushes the lanes whose bit of `which` is set, each onto its medium's stack. */
INLINED void push_packet(World* world, Stacks* stacks, const Packet* packet, const vint which, u32 refracted)
{
    int push[POOL_WIDTH];
    STORE(which, 0, push);
    for (u32 i = 0; i < POOL_WIDTH; i++) {
        if (!push[i]) continue;
        const u32 stack = (lane_medium(packet, i) == VACUUM ? 0u : 2u) + refracted, k = stacks->count[stack];
        if (k == STACK_CAPACITY) {
            COUNT(world, STAT_STACK_OVERFLOW);
            continue;
        }
        stacks->count[stack] = k + 1;
        for (u32 row = 0; row < ROW_COUNT; row++) stacks->rows[stack][row][k] = packet->row[row][i];
        world->stats[refracted ? STAT_REFRACTED : STAT_REFLECTED]++;
    }
}

/* Light in fixed point: its sum does not depend on the order in which rays arrive, nor on their packets. Beyond 128,
 * summed over the samples of a launch, it overflows. */
#define FIXED_ONE 16777216.0f
typedef struct {
    u32 sums[TILE * TILE][3];
} TileLight;

/* What is not a number counts as black. */
INLINED void add_light(TileLight* light, u32 pixel, rgb c)
{
    light->sums[pixel][0] += (u32)convert_int_sat_rte(c.r * FIXED_ONE);
    light->sums[pixel][1] += (u32)convert_int_sat_rte(c.g * FIXED_ONE);
    light->sums[pixel][2] += (u32)convert_int_sat_rte(c.b * FIXED_ONE);
}

INLINED float4 light_at(const TileLight* light, u32 pixel)
{
    const u32* sums = light->sums[pixel];
    return (float4)((float)(int)sums[0], (float)(int)sums[1], (float)(int)sums[2], 0.0f) / FIXED_ONE;
}

#endif
