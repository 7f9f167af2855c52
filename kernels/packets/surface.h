/* The surfaces that a packet's rays meet: as the quick search has them, confirmed by the robust arithmetic of all rays
 * that meet the same primitive at once; by the full search where that is not sure. */
#ifndef CLUCIDA_PACKETS_SURFACE_H
#define CLUCIDA_PACKETS_SURFACE_H

#include "kernels/packets/confirm.h"
#include "kernels/surface.h"

/* The rays' segment as the search takes it. */
INLINED PacketLine packet_rays(const Packet* packet)
{
    PacketLine l;
    l.o = packet_vec(packet, ROW_O);
    l.d = packet_vec(packet, ROW_D);
    l.err = load_lanes(packet->rows[ROW_ERR]);
    l.left = load_ids(packet->ids[ID_LEFT]);
    l.left_inside = load_ids(packet->ids[ID_LEFT_INSIDE]);
    return l;
}

INLINED void put_lane(real rows[3][LANES], u32 lane, real x, real y, real z)
{
    rows[0][lane] = x;
    rows[1][lane] = y;
    rows[2][lane] = z;
}

INLINED void put_surface(PacketSurfaces* surfaces, u32 lane, const Surface* s)
{
    put_lane(surfaces->p, lane, s->p.x, s->p.y, s->p.z);
    put_lane(surfaces->n, lane, s->n.x, s->n.y, s->n.z);
    surfaces->t[lane] = s->t;
    surfaces->err[lane] = s->err;
    surfaces->object[lane] = (int)s->object;
    surfaces->face[lane] = (int)(s->left | (s->entering != s->beyond_inside ? MEMBER_INVERSE : 0u));
    surfaces->before[lane] = signed_medium(s->before);
    surfaces->after[lane] = signed_medium(s->after);
    surfaces->met |= 1u << lane;
}

/* One ray's surface. Returns 0 if the full search is needed after all. */
INLINED int confirm_alone(const World* world, const Packet* packet, const PacketHit* hit, u32 lane, PacketSurfaces* s)
{
    const Ray ray = lane_ray(packet, lane);
    const LaneEnds ends = lane_ends(hit->object, hit->face, hit->t, hit->tolerance);
    const QuickCrossing quick = lane_end(&ends, lane);
    Crossing crossing;
    real spreads[LANES];
    store_wide(hit->spread, spreads);
    if (!confirm(world, &ray, &quick, &crossing)) return 0;
    const real left = (crossing.t <= CLEAR * ray.err ? ray.err : R(0)) + spreads[lane];
    const Surface surface =
        make_surface(world, &ray, quick.object, crossing, left, unsigned_medium(packet->ids[ID_MEDIUM][lane]),
                     unsigned_medium(s->after[lane]));
    put_surface(s, lane, &surface);
    return 1;
}

/* The surfaces that the packet's rays meet, where that is sure. Returns bits of the rays of which it is not. */
INLINED u32 sure_surfaces(World* world, const Packet* packet, PacketSurfaces* s)
{
    PacketLine l = packet_rays(packet);
    const wide_id medium = load_ids(packet->ids[ID_MEDIUM]);
    const wide_mask some = medium != all_ids(MEDIUM_NO_RAY);
    const PacketHit hit = packet_search(world, packet, &l);
    const wide_mask sure = QUICK ? some & hit.sure : all_ids(0);
    const wide excess = load_lanes(packet->rows[ROW_EXCESS]);
    store_ids(hit.object, s->object);
    store_ids(hit.face, s->face);
    store_ids(medium, s->before);
    store_ids(hit.after, s->after);
    wide_mask open = sure & (hit.t < wide_all(INFINITE));
    const u32 met = wide_bits(open);
    u32 unsure = wide_bits(some & ~sure);
    const wide zero = wide_all(R(0)); /* for lanes that meet nothing: they are computed with too */
    for (u32 i = 0; i < 3; i++) {
        store_wide(zero, s->p[i]);
        store_wide(zero, s->n[i]);
    }
    store_wide(zero, s->t);
    store_wide(zero, s->err);
    s->met = 0;
    for (u32 bits = met; bits; bits = wide_bits(open))
        confirm_together(world, &l, excess, &hit, first_lane(bits), &open, s);
    for (u32 rest = met & ~s->met; rest; rest &= rest - 1u) {
        const u32 lane = first_lane(rest);
        if (!confirm_alone(world, packet, &hit, lane, s)) unsure |= 1u << lane;
    }
    return unsure;
}

/* By the full search, which is a call: it would crowd the packets' code out of registers and make compilation long. It
 * gets a copy of the world, so that the packets' own need not lie in memory. */
INLINED void surface_in_full(World* world, const Packet* packet, u32 lane, PacketSurfaces* s)
{
    World copy = *world;
    const Ray ray = lane_ray(packet, lane);
    Surface found;
    const u32 queries = world->stats[STAT_QUERIES];
    const int met = full_surface(&copy, &ray, unsigned_medium(packet->ids[ID_MEDIUM][lane]), &found);
    for (u32 i = 0; i < STAT_COUNT; i++) world->stats[i] = copy.stats[i];
    world->stats[STAT_QUERIES] = queries; /* however many the full search makes of it */
    if (met) put_surface(s, lane, &found);
}

INLINED void packet_surfaces(World* world, const Packet* packet, PacketSurfaces* s)
{
    for (u32 unsure = sure_surfaces(world, packet, s); unsure; unsure &= unsure - 1u)
        surface_in_full(world, packet, first_lane(unsure), s);
}

#endif
