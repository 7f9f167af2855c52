/* What a packet's rays meet, and boundaries too near each other for the quick search: flush faces, which the robust
 * arithmetic of two ends tells apart, or crosses as one. */
#ifndef CLUCIDA_PACKETS_TIES_H
#define CLUCIDA_PACKETS_TIES_H

#include "kernels/packets/packet.h"
#include "kernels/packets/solid.h"
#include "kernels/quick.h"

typedef struct {
    wide t, tolerance; /* t infinite: nothing is met */
    wide_id object, face, after;
    wide_mask sure;
    wide_mask missing; /* the medium has not been looked at */
    /* Where two boundaries are so near each other that this search cannot tell which is met first: the other one. */
    wide_mask tied;
    wide rival_t;
    wide_id rival, rival_face;
    wide spread; /* how far the surface may be from another that is crossed with it */
} PacketHit;

/* Ends of the object `me` that are near the nearest so far, which stays the lesser. A third one is too many. */
INLINED void packet_tie(PacketHit* hit, wide_mask near, wide_id me, const PacketEnd* e, wide apart)
{
    const wide_mask before = near & (e->t < hit->t);
    hit->sure &= ~near | (e->sure & ~hit->tied);
    hit->rival_t = where(near, where(before, hit->t, e->t), hit->rival_t);
    hit->rival = where_id(near, where_id(before, hit->object, me), hit->rival);
    hit->rival_face = where_id(near, where_id(before, hit->face, e->face), hit->rival_face);
    hit->t = where(before, e->t, hit->t);
    hit->object = where_id(before, me, hit->object);
    hit->face = where_id(before, e->face, hit->face);
    hit->tolerance = where(near, apart, hit->tolerance);
    hit->tied |= near;
}

/* Ends of several rays, and one of them as the search of one ray has it. */
typedef struct {
    real t[LANES], tolerance[LANES];
    int object[LANES], face[LANES];
} LaneEnds;

INLINED LaneEnds lane_ends(wide_id object, wide_id face, wide t, wide tolerance)
{
    LaneEnds e;
    store_wide(t, e.t);
    store_wide(tolerance, e.tolerance);
    store_ids(object, e.object);
    store_ids(face, e.face);
    return e;
}
INLINED QuickCrossing lane_end(const LaneEnds* ends, u32 lane)
{
    QuickCrossing c;
    c.t = ends->t[lane];
    c.tolerance = ends->tolerance[lane];
    c.object = (u32)ends->object[lane];
    c.face = (u32)ends->face[lane];
    c.sure = 1;
    return c;
}
/* As quick_untie of each ray. */
INLINED void packet_untie(const World* world, const Packet* packet, PacketHit* hit)
{
    u32 rivals = 0, unsure = 0;
    real spreads[LANES] = {R(0)};
    const LaneEnds ends = lane_ends(hit->object, hit->face, hit->t, hit->tolerance);
    const LaneEnds others = lane_ends(hit->rival, hit->rival_face, hit->rival_t, hit->tolerance);
    for (u32 tied = wide_bits(hit->tied & hit->sure); tied; tied &= tied - 1u) {
        const u32 i = first_lane(tied);
        const Ray ray = lane_ray(packet, i);
        QuickHit lane;
        lane.first = lane_end(&ends, i);
        lane.rival = lane_end(&others, i);
        lane.spread = R(0);
        quick_untie(world, &ray, &lane);
        if (!lane.first.sure)
            unsure |= 1u << i;
        else if (lane.first.object == lane.rival.object)
            rivals |= 1u << i;
        spreads[i] = lane.spread;
    }
    const wide_mask rival = rays_mask(rivals);
    hit->t = where(rival, hit->rival_t, hit->t);
    hit->object = where_id(rival, hit->rival, hit->object);
    hit->face = where_id(rival, hit->rival_face, hit->face);
    hit->sure &= ~rays_mask(unsure);
    hit->spread = load_lanes(spreads);
}

/* As holds_beyond of each ray: of the lanes *known, those whose next points the object `me` holds. Left in *known are
 * those of which the robust arithmetic can tell. */
INLINED wide_mask packet_beyond_end(const World* world, const Packet* packet, PacketHit* hit, wide_id me,
                                    const PacketDoubt* doubt, wide tolerance, wide_mask* known)
{
    u32 holding = 0, told = 0;
    real spreads[LANES];
    const LaneEnds left = lane_ends(hit->object, hit->face, hit->t, hit->tolerance);
    const LaneEnds ends = lane_ends(me, doubt->face, hit->t, tolerance);
    const u32 opens = wide_bits(doubt->opens);
    store_wide(hit->spread, spreads);
    for (u32 some = wide_bits(*known); some; some &= some - 1u) {
        const u32 i = first_lane(some);
        const Ray ray = lane_ray(packet, i);
        const QuickCrossing end = lane_end(&ends, i);
        QuickHit lane;
        lane.first = lane_end(&left, i);
        lane.tied = 0;
        lane.spread = spreads[i];
        const int holds = holds_beyond(world, &ray, &lane, &end, (int)(opens >> i & 1u));
        if (holds < 0) continue;
        told |= 1u << i;
        if (holds) holding |= 1u << i;
        spreads[i] = lane.spread;
    }
    *known = rays_mask(told);
    hit->spread = load_lanes(spreads);
    return rays_mask(holding);
}

#endif
