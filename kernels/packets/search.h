/* Where a packet's rays next leave their media or enter what has precedence over them: the quick search of eight rays
 * at once (kernels/quick.h has it of one). A ray whose search is not sure is left to the full search. */
#ifndef CLUCIDA_PACKETS_SEARCH_H
#define CLUCIDA_PACKETS_SEARCH_H

#include "kernels/packets/ties.h"
#include "kernels/packets/walk.h"

/* Sets the line, and tells which of the rays may meet the object's bounding sphere up to parameter `to`. */
INLINED wide_mask packet_meets(PacketLine* l, __global const LayoutObject* object, wide to)
{
    l->origin = wide_less(l->o, object->center);
    l->start = wide_dot(l->origin, l->d);
    l->base = wide_along(l->origin, l->d, -l->start);
    const wide radius = wide_fma(wide_all(R(32) * UNIT_ROUNDOFF), wide_fabs(l->start), wide_all(R(object->radius)));
    return (wide_dot(l->base, l->base) <= radius * radius) & (radius > l->start) & (-l->start - radius <= to);
}
INLINED void packet_errors(PacketLine* l, __global const LayoutObject* object)
{
    const wide size = wide_fabs(l->start) + wide_max_norm(l->base) + R(object->grain);
    l->error = wide_fma(wide_all(QUICK_ROUNDINGS * R(STORED_ROUNDOFF)), size, l->err);
    l->tolerance = QUICK_SLOPE * l->error;
}

INLINED void count_lanes(World* world, u32 stat, wide_mask lanes)
{
    world->stats[stat] += count_bits(wide_bits(lanes));
}

/* One more object: the nearest crossings stay in *hit. */
INLINED void packet_try(World* world, const PacketWalk* walk, u32 id, wide_mask rays, wide_id medium, PacketLine* l,
                        PacketHit* hit)
{
    __global const LayoutObject* object = &world->objects[id];
    const wide_id me = all_ids((int)id);
    const wide_mask inside = medium == me;
    const wide to = hit->t + hit->tolerance;
    wide_mask want = rays & ~(medium < me) & (inside | packet_meets(l, object, to));
    if (!any_lane(want)) return;
    want &= inside | packet_meets_box(walk, world, -l->err, to);
    if (!any_lane(want)) return;
    count_lanes(world, STAT_TESTS, want);
    packet_errors(l, object);
    const PacketEnd e = packet_crossing(world, object, l, want, inside);
    const wide apart = wide_larger(l->tolerance, hit->tolerance), infinite = wide_all(INFINITE);
    const wide_mask met = want & e.met, nearer = met & ((e.t < hit->t - apart) | (hit->t == infinite));
    const wide_mask near = met & ~nearer & (e.t <= hit->t + apart);
    if (any_lane(near)) packet_tie(hit, near, me, &e, apart);
    hit->t = where(nearer, e.t, hit->t);
    hit->tolerance = where(nearer, l->tolerance, hit->tolerance);
    hit->object = where_id(nearer, me, hit->object);
    hit->face = where_id(nearer, e.face, hit->face);
    hit->sure = where_id(nearer, e.sure, hit->sure);
    hit->tied &= ~nearer;
    hit->missing &= ~(want & inside);
}

/* Of the rays that leave a medium, what they come into goes to hit->after: the first object below it that holds the
 * point just beyond. */
INLINED void packet_look_beyond(World* world, const Packet* packet, wide_id medium, wide_mask seeking, PacketLine* l,
                                PacketHit* hit)
{
    const wide t = where(seeking, hit->t, wide_all(R(0)));
    const wide_mask leaving = medium != all_ids(MEDIUM_NO_RAY);
    const wide_vec p = wide_along(l->o, l->d, t);
    PacketWalk walk;
    packet_walk_begin(&walk, world, l->o, l->d);
    for (;;) {
        wide_mask rays;
        const u32 id = packet_walk_next(&walk, world, t, where(seeking, t, wide_all(-INFINITE)), &rays);
        if (id == WALK_DONE) return;
        __global const LayoutObject* object = &world->objects[id];
        const wide_id me = all_ids((int)id);
        const wide_vec q = wide_less(p, object->center);
        const wide radius =
            wide_fma(wide_all(R(32) * UNIT_ROUNDOFF), t + wide_max_norm(p), wide_all(R(object->radius)));
        wide_mask want = rays & seeking & (me > medium) & (me < hit->after) & (wide_dot(q, q) <= radius * radius);
        if (!any_lane(want)) continue;
        want &= packet_meets_box(&walk, world, t, t);
        if (!any_lane(want)) continue;
        count_lanes(world, STAT_TESTS, want);
        packet_meets(l, object, t);
        packet_errors(l, object);
        const wide_mask asked = want;
        PacketDoubt doubt;
        wide_mask holds = packet_holds(world, object, l, t + l->start, &want, &doubt);
        wide_mask known = doubt.some & ~hit->tied & leaving;
        if (any_lane(known)) {
            hit->tied |= known;
            holds |= packet_beyond_end(world, packet, hit, me, &doubt, R(2) * l->tolerance, &known);
            want |= known;
        }
        hit->after = where_id(holds, me, hit->after);
        hit->sure &= ~(asked & ~want);
        seeking &= hit->sure;
    }
}

INLINED PacketHit packet_search(World* world, const Packet* packet, PacketLine* l)
{
    PacketHit hit;
    const wide_id medium = load_ids(packet->ids[ID_MEDIUM]);
    hit.t = wide_all(INFINITE);
    hit.tolerance = wide_all(R(0));
    hit.object = hit.after = all_ids(MEDIUM_VACUUM);
    hit.face = all_ids((int)MEMBER_NONE);
    hit.sure = all_ids(-1);
    hit.tied = all_ids(0);
    hit.rival_t = hit.t;
    hit.spread = wide_all(R(0));
    hit.rival = hit.rival_face = hit.face;
    hit.missing = (medium < all_ids(MEDIUM_VACUUM)) & (medium > all_ids(MEDIUM_NO_RAY));
    PacketWalk walk;
    packet_walk_begin(&walk, world, l->o, l->d);
    const wide_mask some = medium != all_ids(MEDIUM_NO_RAY);
    for (;;) {
        wide_mask rays;
        const wide to = where(some, hit.t + hit.tolerance, wide_all(-INFINITE));
        const u32 id = packet_walk_next(&walk, world, -l->err, to, &rays);
        if (id == WALK_DONE) break;
        packet_try(world, &walk, id, rays, medium, l, &hit);
    }
    hit.sure &= ~hit.missing;
    if (any_lane(hit.tied & hit.sure)) packet_untie(world, packet, &hit);
    const wide_mask seeking = hit.sure & (hit.t < wide_all(INFINITE)) & (hit.object == medium);
    hit.after = where_id(seeking, all_ids(MEDIUM_VACUUM), hit.object);
    if (any_lane(seeking)) packet_look_beyond(world, packet, medium, seeking, l, &hit);
    return hit;
}

#ifdef CLU_LIGHTS
/* Of the shadow rays of *open, which start outside of all objects, those that are hidden before they reach that far.
 * Left in *open are those for which that is not sure. */
INLINED wide_mask packet_hidden(World* world, PacketLine* l, wide distance, wide_mask* open)
{
    wide_mask hidden = all_ids(0), doubtful = all_ids(0);
    PacketWalk walk;
    packet_walk_begin(&walk, world, l->o, l->d);
    while (any_lane(*open & ~hidden)) {
        wide_mask rays;
        const wide to = where(*open & ~hidden, distance, wide_all(-INFINITE));
        const u32 id = packet_walk_next(&walk, world, wide_all(R(0)), to, &rays);
        if (id == WALK_DONE) break;
        __global const LayoutObject* object = &world->objects[id];
        wide_mask want = rays & *open & ~hidden & packet_meets(l, object, distance);
        if (!any_lane(want)) continue;
        want &= packet_meets_box(&walk, world, wide_all(R(0)), distance);
        if (!any_lane(want)) continue;
        count_lanes(world, STAT_TESTS, want);
        packet_errors(l, object);
        const PacketEnd e = packet_crossing(world, object, l, want, all_ids(0));
        const wide_mask met = want & e.met;
        hidden |= met & e.sure & (e.t + l->tolerance < distance);
        doubtful |= met & (e.t - l->tolerance <= distance);
    }
    *open &= doubtful & ~hidden;
    return hidden;
}
#endif

#endif
