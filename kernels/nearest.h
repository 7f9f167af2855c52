/* The full search over the objects: the nearest crossing with all that coincide with it. */
#ifndef CLUCIDA_NEAREST_H
#define CLUCIDA_NEAREST_H

#include "kernels/csg.h"
#include "kernels/interior.h"
#include "kernels/tree.h"

/* Boundaries crossed as one, the nearest at t. More than fit are met again at once by the next search. */
#define INTERFACE_CAPACITY 6
typedef struct {
    real t;
    u32 count;
    u32 ids[INTERFACE_CAPACITY];
    Crossing crossings[INTERFACE_CAPACITY];
} Interface;

static inline void interface_add(Interface* face, u32 id, Crossing crossing)
{
    if (crossing.t < face->t) {
        /* The new nearest goes last; what no longer coincides with it goes away. */
        const u32 before = face->count;
        face->t = crossing.t;
        face->count = 0;
        for (u32 i = 0; i < before && face->count < INTERFACE_CAPACITY - 1; i++) {
            if (!coincides(crossing, face->crossings[i])) continue;
            face->ids[face->count] = face->ids[i];
            face->crossings[face->count] = face->crossings[i];
            face->count++;
        }
    } else if (face->count == INTERFACE_CAPACITY || !coincides(face->crossings[face->count - 1], crossing)) {
        return;
    }
    face->ids[face->count] = id;
    face->crossings[face->count] = crossing;
    face->count++;
}

/* How far ray parameter t may be from each of the interface's boundaries, at right angles to them. */
static inline real interface_spread(const Interface* face, real t)
{
    real spread = R(0);
    for (u32 i = 0; i < face->count; i++) {
        spread = larger(spread, distance_at(&face->crossings[i], t));
    }
    return spread;
}

/* Whether several objects are left at the interface and none is entered. */
static inline int interface_leaves(const Interface* face, const Interior* interior)
{
    if (face->count < 2) return 0;
    for (u32 i = 0; i < face->count; i++)
        if (!interior_has(interior, face->ids[i])) return 0;
    return 1;
}

/* The objects that a full search looks at, one after the other: those of the interior, those that the ray meets, and
 * once more those that it leaves together: one may be entered anew before rounding can tell, and no gap is seen then:
 * it counts twice. */
typedef struct {
    Walk walk;
    u32 next;  /* of the interior's, or of those once more */
    u32 again; /* how many once more; 0 before */
} Candidates;

/* The next one, with whether it is of the interior; WALK_DONE after the last. Nearer than `from` is no matter. */
static inline u32 next_candidate(World* world, Candidates* c, const Interior* interior, const Interface* face,
                                 real from, real err, int* inside)
{
    *inside = !c->again && c->next < interior->count;
    if (*inside) return interior->ids[c->next++];
    while (!c->again) {
        const u32 id = walk_next(&c->walk, world, from, face->t + err);
        if (id == WALK_DONE) {
            if (!interface_leaves(face, interior)) return WALK_DONE;
            c->again = face->count;
            c->next = 0;
        } else if (!interior_has(interior, id)) {
            return id;
        }
    }
    return c->next < c->again ? face->ids[c->next++] : WALK_DONE;
}

/* The nearest crossing of any object from ray parameter x on, and those that rounding cannot tell from it. Returns 0 if
 * there is none. */
static inline int nearest_interface(World* world, const Ray* ray, real x, real err, const Interior* interior,
                                    Interface* face)
{
    face->t = INFINITE;
    face->count = 0;
    COUNT(world, STAT_QUERIES);
    Candidates candidates;
    candidates.next = candidates.again = 0;
    walk_begin(&candidates.walk, ray);
    for (;;) {
        int inside;
        const u32 id = next_candidate(world, &candidates, interior, face, x - err, err, &inside);
        if (id == WALK_DONE) return face->count > 0;
        COUNT(world, STAT_TESTS);
        const Line line = make_line(ray, &world->objects[id]);
        Place place = place_at(&line, x, err, inside);
        const int again = candidates.again > 0;
        if (again) {
            const Crossing left = face->crossings[candidates.next - 1];
            place.t = left.t;
            place.at = left.at;
            if (left.t > x) place.err = R(0);
        }
        Crossing crossing;
        if (object_crossing(world, &world->objects[id], &line, place, &crossing) && (!again || crossing.t > place.t))
            interface_add(face, id, crossing);
    }
}

/* The objects that hold the ray's start, just after it; of the medium there and those above it that is known. */
static inline void find_interior(World* world, const Ray* ray, u32 medium, Interior* interior)
{
    interior->count = 0;
    if (medium == VACUUM) return;
    interior_toggle(world, interior, medium);
    Walk walk;
    walk_begin(&walk, ray);
    for (;;) {
        const u32 id = walk_next(&walk, world, -ray->err, ray->err);
        if (id == WALK_DONE) return;
        if (id <= medium) continue;
        COUNT(world, STAT_TESTS);
        const Line line = make_line(ray, &world->objects[id]);
        if (object_holds_start(world, &world->objects[id], &line)) interior_toggle(world, interior, id);
    }
}

#endif
