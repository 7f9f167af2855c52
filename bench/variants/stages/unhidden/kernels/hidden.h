/* Nothing hides a light: no shadow ray is searched. */
#define is_hidden is_hidden_truly
#include "full/kernels/hidden.h"
#undef is_hidden

#ifdef CLU_LIGHTS
INLINED int is_hidden(World* world, const Ray* ray, real distance)
{
    (void)ray;
    (void)distance;
    COUNT(world, STAT_SHADOW);
    return 0;
}
#endif
