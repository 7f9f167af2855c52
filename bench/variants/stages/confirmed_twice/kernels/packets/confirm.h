/* Every surface is confirmed once more, as in confirmed_twice/kernels/quick.h. */
#define confirm_together confirm_together_once
#include "full/kernels/packets/confirm.h"
#undef confirm_together

INLINED void confirm_together(const World* world, const PacketLine* l, wide excess, const PacketHit* hit, u32 lane,
                              wide_mask* open, PacketSurfaces* s)
{
    volatile u32 which = lane;
    const wide_mask before = *open;
    for (u32 i = 0; i <= world->frame->samples; i++) {
        *open = before;
        confirm_together_once(world, l, excess, hit, which, open, s);
    }
}
