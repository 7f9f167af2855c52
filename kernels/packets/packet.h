/* Eight rays that are traced side by side. */
#ifndef CLUCIDA_PACKETS_PACKET_H
#define CLUCIDA_PACKETS_PACKET_H

#include "kernels/color.h"
#include "kernels/packets/lanes.h"

/* What is kept of a ray. */
enum PacketRow {
    ROW_O, /* x, y, z */
    ROW_D = ROW_O + 3,
    ROW_EXCESS = ROW_D + 3,
    ROW_ERR,
    ROW_THROUGHPUT, /* red, green, blue */
    ROW_WEIGHT = ROW_THROUGHPUT + 3,
    ROW_COUNT = ROW_WEIGHT + 3
};
enum PacketId {
    ID_LEFT,        /* bits of a reference */
    ID_LEFT_INSIDE, /* -1 or 0 */
    ID_MEDIUM,      /* an object or MEDIUM_* */
    ID_TAG,         /* the pixel's number within the tile | segments left << PIXEL_BITS */
    ID_COUNT
};

/* Media as signed numbers, so that an object has precedence over a medium if its number is less. */
#define MEDIUM_VACUUM 0x7fffffff
#define MEDIUM_NO_RAY (-1) /* an empty lane: nothing has precedence over it */

typedef struct {
    real rows[ROW_COUNT][LANES];
    int ids[ID_COUNT][LANES];
} Packet;

INLINED wide_vec packet_vec(const Packet* packet, u32 row)
{
    return make_wide_vec(load_lanes(packet->rows[row]), load_lanes(packet->rows[row + 1]),
                         load_lanes(packet->rows[row + 2]));
}
INLINED void put_vec(Packet* packet, u32 row, wide_vec v)
{
    store_wide(v.x, packet->rows[row]);
    store_wide(v.y, packet->rows[row + 1]);
    store_wide(v.z, packet->rows[row + 2]);
}
/* Puts the vectors of some lanes into rows. */
INLINED void put_where(wide_mask lanes, wide_vec v, real rows[3][LANES])
{
    store_wide(where(lanes, v.x, load_lanes(rows[0])), rows[0]);
    store_wide(where(lanes, v.y, load_lanes(rows[1])), rows[1]);
    store_wide(where(lanes, v.z, load_lanes(rows[2])), rows[2]);
}
INLINED rgb lane_color(const Packet* packet, u32 row, u32 lane)
{
    return make_rgb(packet->rows[row][lane], packet->rows[row + 1][lane], packet->rows[row + 2][lane]);
}
INLINED int signed_medium(u32 medium)
{
    return medium == VACUUM ? MEDIUM_VACUUM : (int)medium;
}
INLINED u32 unsigned_medium(int medium)
{
    return medium == MEDIUM_VACUUM ? VACUUM : (u32)medium;
}
INLINED Ray lane_ray(const Packet* packet, u32 lane)
{
    Ray ray;
    ray.o = make_vec(packet->rows[ROW_O][lane], packet->rows[ROW_O + 1][lane], packet->rows[ROW_O + 2][lane]);
    ray.d = make_vec(packet->rows[ROW_D][lane], packet->rows[ROW_D + 1][lane], packet->rows[ROW_D + 2][lane]);
    ray.excess = packet->rows[ROW_EXCESS][lane];
    ray.left = (u32)packet->ids[ID_LEFT][lane];
    ray.left_inside = packet->ids[ID_LEFT_INSIDE][lane] != 0;
    ray.err = packet->rows[ROW_ERR][lane];
    return ray;
}

#endif
