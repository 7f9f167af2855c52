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

/* Looks for the object's crossing from place on, and adds it to the interface if it belongs there. */
static inline void interface_try(World* world, u32 id, const Line* line, Place place, Interface* face)
{
    Crossing crossing;
    COUNT(world, STAT_TESTS);
    if (object_crossing(world, &world->objects[id], line, place, &crossing)) interface_add(face, id, crossing);
}

/* Where objects are left together, one may be entered again before rounding can tell, and no gap is seen then: it
 * counts twice. */
static inline void interface_again(World* world, const Ray* ray, real x, real err, Interface* face)
{
    const u32 count = face->count;
    for (u32 i = 0; i < count; i++) {
        const u32 id = face->ids[i];
        __global const LayoutObject* object = &world->objects[id];
        const Line line = make_line(ray, object);
        Place place = place_at(&line, x, err, 0);
        if (face->crossings[i].t > x) place.err = R(0);
        place.t = face->crossings[i].t;
        place.at = face->crossings[i].at;
        Crossing crossing;
        COUNT(world, STAT_TESTS);
        if (object_crossing(world, object, &line, place, &crossing) && crossing.t > place.t)
            interface_add(face, id, crossing);
    }
}

/* The nearest crossing of any object from ray parameter x on, and those that rounding cannot tell from it. Returns 0 if
 * there is none. */
static inline int nearest_interface(World* world, const Ray* ray, real x, real err, const Interior* interior,
                                    Interface* face)
{
    face->t = INFINITE;
    face->count = 0;
    COUNT(world, STAT_QUERIES);
    Walk walk;
    walk_begin(&walk, ray);
    for (u32 i = 0;; i++) {
        const int inside = i < interior->count;
        const u32 id = inside ? interior->ids[i] : walk_next(&walk, world, x - err, face->t + err);
        if (id == WALK_DONE) break;
        if (!inside && interior_has(interior, id)) continue;
        const Line line = make_line(ray, &world->objects[id]);
        interface_try(world, id, &line, place_at(&line, x, err, inside), face);
    }
    if (interface_leaves(face, interior)) interface_again(world, ray, x, err, face);
    return face->count > 0;
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
