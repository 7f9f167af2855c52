/* Searches over the objects: the nearest crossing with all that coincide with it, and whether a light is hidden. */
#ifndef CLUCIDA_NEAREST_H
#define CLUCIDA_NEAREST_H

#include "kernels/csg.h"
#include "kernels/interior.h"

/* Boundaries crossed as one, the nearest at t. More than fit are met again at once by the next search. */
#define INTERFACE_CAPACITY 6
typedef struct {
    real t;
    u32 count;
    u32 ids[INTERFACE_CAPACITY];
    Crossing crossings[INTERFACE_CAPACITY];
} Interface;

/* Whether the object's bounding sphere is met between ray parameters from and to. Conservative: the radius has the
 * host's margin, and grows here by what rounding may do to a sphere that is far away. */
static inline int bound_met(__global const LayoutObject* object, const Ray* ray, real from, real to)
{
    if (!is_finite(R(object->radius))) return 1;
    const vec c = sub(load_vec(object->center), ray->o);
    const real middle = dot3(c, ray->d); /* |d| is 1 to within rounding */
    const vec offset = along(c, ray->d, -middle);
    const real radius = R(object->radius) + R(8) * UNIT_ROUNDOFF * fabs(middle);
    return dot3(offset, offset) <= radius * radius && from <= middle + radius && to >= middle - radius;
}

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

/* The nearest crossing of any object from ray parameter x on, and those that rounding cannot tell from it. Returns 0 if
 * there is none. Where objects are left together, one may be entered again before rounding can tell, and no gap is seen
 * then: it counts twice. */
static inline int nearest_interface(World* world, const Ray* ray, real x, real err, const Interior* interior,
                                    Interface* face)
{
    const u32 count = world->frame->object_count;
    face->t = INFINITE;
    face->count = 0;
    COUNT(world, STAT_QUERIES);
    for (u32 i = 0, again = 0; i < count + again; i++) {
        const u32 id = i < count ? i : face->ids[i - count];
        __global const LayoutObject* object = &world->objects[id];
        const int inside = i < count && interior_has(interior, id);
        if (inside || i >= count || bound_met(object, ray, x - err, face->t + err)) {
            COUNT(world, STAT_TESTS);
            const Line line = make_line(ray, object);
            Place place = place_at(&line, x, err, inside);
            if (i >= count) {
                if (face->crossings[i - count].t > x) place.err = R(0);
                place.t = face->crossings[i - count].t;
                place.at = face->crossings[i - count].at;
            }
            Crossing crossing;
            if (object_crossing(world, object, &line, place, &crossing) && (i < count || crossing.t > place.t))
                interface_add(face, id, crossing);
        }
        if (i + 1 == count && interface_leaves(face, interior)) again = face->count;
    }
    return face->count > 0;
}

#ifdef CLU_LIGHTS
/* Whether any solid's boundary lies between the ray's start and the light at the given distance. A boundary that the
 * light itself lies on does not count. */
static inline int is_hidden(World* world, const Ray* ray, real distance)
{
    const u32 count = world->frame->object_count;
    const real err = position_error(ray->o, distance);
    COUNT(world, STAT_SHADOW);
    for (u32 id = 0; id < count; id++) {
        __global const LayoutObject* object = &world->objects[id];
        if (!bound_met(object, ray, R(0), distance)) continue;
        COUNT(world, STAT_TESTS);
        const Line line = make_line(ray, object);
        Crossing crossing;
        if (object_crossing(world, object, &line, place_at(&line, R(0), ray->err, 0), &crossing) &&
            crossing.t + crossing.slope * err < distance)
            return 1;
    }
    return 0;
}
#endif

#endif
