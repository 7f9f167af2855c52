/* No ray meets anything: what is left is the observer's rays, the sky and the way back. */
#define next_surface next_surface_seen
#include "full/kernels/surface.h"
#undef next_surface

INLINED int next_surface(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    (void)world;
    (void)ray;
    (void)medium;
    (void)surface;
    return 0;
}
