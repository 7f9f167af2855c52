/* Every full search is done once more for each sample of a pixel. */
#define full_surface full_surface_once
#define next_surface next_surface_once
#include "full/kernels/surface.h"
#undef full_surface
#undef next_surface

static CALLED int full_surface(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    int found = 0;
    for (u32 i = 0; i <= world->frame->samples; i++) found = full_surface_once(world, ray, medium, surface);
    return found;
}

INLINED int next_surface(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    COUNT(world, STAT_QUERIES);
    const int found = quick_surface(world, ray, medium, surface);
    return found < 0 ? full_surface(world, ray, medium, surface) : found;
}
