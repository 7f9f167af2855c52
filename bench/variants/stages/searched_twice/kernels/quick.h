/* Every search is done once more for each sample of a pixel. Compilers do not know how many there are. */
#define quick_nearest quick_nearest_once
#include "full/kernels/quick.h"
#undef quick_nearest

INLINED QuickHit quick_nearest(World* world, const Ray* ray, u32 medium)
{
    QuickHit hit;
    for (u32 i = 0; i <= world->frame->samples; i++) hit = quick_nearest_once(world, ray, medium);
    return hit;
}
