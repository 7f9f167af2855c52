/* Every surface is confirmed once more for each sample of a pixel. The volatile number hides from compilers that it is
 * the same one. */
#define confirm confirm_once
#include "full/kernels/quick.h"
#undef confirm

INLINED int confirm(const World* world, const Ray* ray, const QuickCrossing* quick, Crossing* crossing)
{
    volatile u32 object = quick->object;
    int good = 0;
    for (u32 i = 0; i <= world->frame->samples; i++) {
        QuickCrossing same = *quick;
        same.object = object;
        good = confirm_once(world, ray, &same, crossing);
    }
    return good;
}
