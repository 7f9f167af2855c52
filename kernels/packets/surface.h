/* The surfaces that a packet's rays meet: as the quick search has them, confirmed by the robust arithmetic of all rays
 * that meet the same primitive at once; by the full search where that is not sure. */
#ifndef CLUCIDA_PACKETS_SURFACE_H
#define CLUCIDA_PACKETS_SURFACE_H

#include "kernels/packets/ends.h"
#include "kernels/packets/search.h"
#include "kernels/surface.h"

/* As Surface (kernels/surface.h) has it of one ray. */
typedef struct {
    real p[3][LANES], n[3][LANES]; /* n: outward */
    real t[LANES], err[LANES];
    int object[LANES], face[LANES], before[LANES], after[LANES]; /* media as MEDIUM_* has them */
    u32 met;                                                     /* a bit of each ray that meets a surface */
} PacketSurfaces;

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

/* Where rays meet a primitive, by arithmetic that is the same for one ray, and the normal there. */
typedef struct {
    wide at;
    wide_vec p, n; /* p relative to the object's centre */
    wide_mask known;
} PacketContact;

/* near: the parameters on the line, of which the contact is the nearer end. */
INLINED PacketContact packet_contact(const World* world, u32 face, const PacketLine* l, const WideLine* line, wide near)
{
    const u32 index = face >> MEMBER_SHIFT;
    const wide_mask left = wide_is(l->left, face & ~MEMBER_INVERSE);
    PacketContact c;
    WideEnds e;
    c.known = ~left;
    e.lo = e.hi = wide_all(INFINITE);
    switch (face & MEMBER_KIND) {
#ifdef CLU_PLANE
    case MEMBER_PLANE: e = wide_plane_ends(&world->planes[index], line); break;
#endif
#ifdef CLU_SPHERE
    case MEMBER_SPHERE:
        c.known |= l->left_inside;
        e = wide_sphere_ends(&world->spheres[index], line, left & l->left_inside);
        break;
#endif
#ifdef CLU_QUADRIC
    case MEMBER_QUADRIC: e = wide_quadric_ends(&world->quadrics[index], line, &c.known); break;
#endif
    default: c.known = all_ids(0); break;
    }
    c.at = where(wide_fabs(e.hi - near) < wide_fabs(e.lo - near), e.hi, e.lo);
    c.p = wide_along(line->base, line->d, c.at);
    c.n = c.p;
    switch (face & MEMBER_KIND) {
#ifdef CLU_PLANE
    case MEMBER_PLANE: c.n = wide_plane_normal(&world->planes[index], &c.p); break;
#endif
#ifdef CLU_SPHERE
    case MEMBER_SPHERE: c.n = wide_sphere_normal(&world->spheres[index], &c.p); break;
#endif
#ifdef CLU_QUADRIC
    case MEMBER_QUADRIC: c.n = wide_quadric_normal(&world->quadrics[index], &c.p); break;
#endif
    default: break;
    }
    if (face & MEMBER_INVERSE) c.n = wide_scaled(c.n, wide_all(R(-1)));
    return c;
}

/* The surfaces of the rays that meet what `lane` meets, out of those of *open, which are taken from that. */
INLINED void confirm_together(const World* world, const PacketLine* l, wide excess, const PacketHit* hit, u32 lane,
                              wide_mask* open, PacketSurfaces* s)
{
    const u32 id = (u32)s->object[lane], face = (u32)s->face[lane];
    __global const LayoutObject* object = &world->objects[id];
    const wide_mask same = *open & wide_is(hit->object, id) & wide_is(hit->face, face);
    *open &= ~same;
    const WideLine line = wide_line(l->o, l->d, excess, object);
    const PacketContact c = packet_contact(world, face, l, &line, hit->t + line.start);
    const wide t = c.at - line.start;
    const wide_mask good = same & c.known & (wide_fabs(t - hit->t) <= hit->tolerance);
    const wide_vec p =
        make_wide_vec(R(object->center[0]) + c.p.x, R(object->center[1]) + c.p.y, R(object->center[2]) + c.p.z);
    const wide left = where(t <= CLEAR * l->err, l->err, wide_all(R(0)));
    const wide err = wide_surface_error(&line, c.at, p) + (left + hit->spread);
    put_where(good, p, s->p);
    put_where(good, c.n, s->n);
    store_wide(where(good, t, load_lanes(s->t)), s->t);
    store_wide(where(good, err, load_lanes(s->err)), s->err);
    s->met |= wide_bits(good);
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
