/* Whether a light is hidden. */
#ifndef CLUCIDA_HIDDEN_H
#define CLUCIDA_HIDDEN_H

#include "kernels/quick.h"

#ifdef CLU_LIGHTS
/* By the full search. A boundary that the light itself lies on does not count. */
static CALLED int is_hidden_in_full(World* world, const Ray* ray, real distance)
{
    const real err = position_error(ray->o, distance);
    COUNT(world, STAT_FULL);
    Walk walk;
    walk_begin(&walk, ray);
    for (;;) {
        const u32 id = walk_next(&walk, world, R(0), distance);
        if (id == WALK_DONE) return 0;
        COUNT(world, STAT_TESTS);
        const Line line = make_line(ray, &world->objects[id]);
        Crossing crossing;
        if (object_crossing(world, &world->objects[id], &line, place_at(&line, R(0), ray->err, 0), &crossing) &&
            crossing.t + crossing.slope * err < distance)
            return 1;
    }
}

/* Whether any solid's boundary lies between the ray's start, which no object holds, and the light at that distance. */
INLINED int is_hidden(World* world, const Ray* ray, real distance)
{
    int sure = QUICK;
    Walk walk;
    COUNT(world, STAT_SHADOW);
    walk_begin(&walk, ray);
    while (QUICK) {
        const u32 id = walk_next(&walk, world, R(0), distance);
        if (id == WALK_DONE) break;
        QuickCrossing c;
        COUNT(world, STAT_TESTS);
        if (!quick_crossing(world, id, ray, 0, &c)) continue;
        if (c.sure && c.t + c.tolerance < distance) return 1;
        if (c.t - c.tolerance <= distance) sure = 0;
    }
    return sure ? 0 : is_hidden_in_full(world, ray, distance);
}
#endif

#endif
