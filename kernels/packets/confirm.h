/* The surface that rays meet, by arithmetic that is robust: of all rays that meet the same primitive at once. */
#ifndef CLUCIDA_PACKETS_CONFIRM_H
#define CLUCIDA_PACKETS_CONFIRM_H

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

#endif
