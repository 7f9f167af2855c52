/* The observer's rays end at the first surface, which has no optics: its place and normal stand for a colour, so that
 * no compiler leaves them out. */
#define trace trace_shaded
#include "full/kernels/trace.h"
#undef trace

INLINED rgb trace(World* world, Branch* branch)
{
    Surface s;
    COUNT(world, STAT_RAYS);
    COUNT(world, STAT_PRIMARY);
    if (!next_surface(world, &branch->ray, branch->medium, &s))
        return sky_through(world, branch->medium, branch->ray.d);
    return make_rgb(s.p.x * s.n.x, s.p.y * s.n.y, s.p.z * s.n.z + s.t + s.err);
}
