/* The next optically present surface along a ray: precedence decides, silent crossings are passed by. */
#ifndef CLUCIDA_SURFACE_H
#define CLUCIDA_SURFACE_H

#include "kernels/nearest.h"

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

/* From the ray's start to the next surface. interior is that of the start; it becomes that just before the surface,
 * and beyond that just after. Returns 0 if the ray meets no surface any more. */
INLINED int next_surface(World* world, const Ray* ray, Interior* interior, Interior* beyond, Surface* surface)
{
    real x = R(0), err = ray->err;
    const u32 most = 16u * world->frame->object_count + 64u;
    u32 passed = VACUUM;
    Interface face;
    for (u32 step = 0; step < most; step++) {
        if (!nearest_interface(world, ray, x, err, passed, interior, &face)) return 0;
        interior_copy(beyond, interior);
        for (u32 i = 0; i < face.count; i++) interior_toggle(world, beyond, face.ids[i]);
        const real here = position_error(ray->o, face.t) + interface_spread(&face, face.t);
        const u32 before = medium_of(interior), after = medium_of(beyond);
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
        interior_copy(interior, beyond);
        /* What lay about the last place counts as passed until it is clear of. */
        err = face.t - x <= CLEAR * err ? larger(err, here) : here;
        x = face.t;
        passed = face.count == 1 ? face.ids[0] : VACUUM;
    }
    COUNT(world, STAT_STUCK);
    return 0;
}

#endif
