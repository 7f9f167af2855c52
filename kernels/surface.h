/* The next optically present surface along a ray: precedence decides, silent crossings are passed by. */
#ifndef CLUCIDA_SURFACE_H
#define CLUCIDA_SURFACE_H

#include "kernels/nearest.h"
#include "kernels/quick.h"

typedef struct {
    real t;            /* distance from the ray's origin */
    vec p;             /* the point, relative to the eye */
    vec n;             /* outward unit normal of the object */
    vec facing;        /* the normal on the side that the ray comes from */
    real cosine;       /* of the angle of incidence, >= 0 */
    real err;          /* how far p may lie from this surface and those that coincide with it */
    u32 object;        /* whose surface it is: the highest in precedence of those left and entered */
    u32 before, after; /* the media in force on the two sides */
    int entering;      /* the object is entered, not left */
    u32 left;          /* the primitive, as a ray that leaves it names it */
    int beyond_inside; /* whether the far side is the primitive's inside */
} Surface;

/* err: how far the point may lie from boundaries that were crossed here or on the way, its own rounding apart. */
INLINED Surface make_surface(const World* world, const Ray* ray, u32 id, Crossing crossing, real err, u32 before,
                             u32 after)
{
    Surface s;
    const Line line = make_line(ray, &world->objects[id]);
    vec p = along(line.base, line.d, crossing.at);
    s.n = member_normal(world, crossing.face, &p);
    s.p = add(load_vec(world->objects[id].center), p);
    s.t = crossing.t;
    s.err = surface_error(&line, crossing.at, s.p) + err;
    s.object = id;
    s.before = before;
    s.after = after;
    s.entering = after == id;
    s.facing = s.entering ? s.n : scaled(s.n, R(-1));
    s.cosine = fmin(fmax(-dot3(ray->d, s.facing), R(0)), R(1));
    s.left = crossing.face & ~MEMBER_INVERSE;
    s.beyond_inside = s.entering != ((crossing.face & MEMBER_INVERSE) != 0u);
    return s;
}

/* A ray is clear of what lay within err of its start after this many times err, but for the most grazing. */
#define CLEAR R(64)

/* From the start of a ray in a medium to the next surface, by the full search. Returns 0 if there is none. */
static CALLED int full_surface(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    real x = R(0), err = ray->err;
    const u32 most = 16u * world->frame->object_count + 64u;
    Interior interior, beyond;
    Interface face;
    COUNT(world, STAT_FULL);
    find_interior(world, ray, medium, &interior);
    for (u32 step = 0; step < most; step++) {
        if (!nearest_interface(world, ray, x, err, &interior, &face)) return 0;
        interior_copy(&beyond, &interior);
        for (u32 i = 0; i < face.count; i++) interior_toggle(world, &beyond, face.ids[i]);
        const real here = position_error(ray->o, face.t) + interface_spread(&face, face.t);
        const u32 before = medium_of(&interior), after = medium_of(&beyond);
        if (before != after) {
            const u32 shown = before < after ? before : after;
            u32 i = 0;
            while (i + 1 < face.count && face.ids[i] != shown) i++;
            if (face.crossings[i].face != MEMBER_NONE) {
                const real shared = step > 0 ? here : R(0);
                const real left = face.t - x <= CLEAR * err ? err : R(0);
                const real spread = interface_spread(&face, face.crossings[i].t);
                *surface =
                    make_surface(world, ray, shown, face.crossings[i], larger(shared, left) + spread, before, after);
                return 1;
            }
        }
        COUNT(world, STAT_SILENT);
        interior_copy(&interior, &beyond);
        /* What lay about the last place counts as passed until it is clear of. */
        err = face.t - x <= CLEAR * err ? larger(err, here) : here;
        x = face.t;
    }
    COUNT(world, STAT_STUCK);
    return 0;
}

/* Likewise by the quick search; -1 if that is not sure. */
INLINED int quick_surface(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    QuickHit hit = quick_nearest(world, ray, medium);
    if (hit.first.t == INFINITE) return 0;
    if (!hit.first.sure) return -1;
    u32 after = hit.first.object;
    Crossing crossing;
    if (after == medium && !quick_medium(world, ray, hit.first.t, medium, &hit, &after)) return -1;
    if (!confirm(world, ray, &hit.first, &crossing)) return -1;
    const real left = crossing.t <= CLEAR * ray->err ? ray->err : R(0);
    *surface = make_surface(world, ray, hit.first.object, crossing, left + hit.spread, medium, after);
    return 1;
}

/* From the start of a ray in a medium to the next surface. Returns 0 if the ray meets no surface any more. */
INLINED int next_surface(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    COUNT(world, STAT_QUERIES);
    const int found = quick_surface(world, ray, medium, surface);
    return found < 0 ? full_surface(world, ray, medium, surface) : found;
}

#endif
