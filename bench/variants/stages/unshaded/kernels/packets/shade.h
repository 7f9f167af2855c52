/* The observer's rays end at the first surface, as in unshaded/kernels/trace.h. */
#define shade_packet shade_packet_fully
#include "full/kernels/packets/shade.h"
#undef shade_packet

INLINED void shade_packet(World* world, PacketStacks* stacks, const Packet* packet, const PacketSurfaces* s,
                          TileLight* light)
{
    (void)stacks;
    shade_sky(world, wide_bits(load_ids(packet->ids[ID_MEDIUM]) != all_ids(MEDIUM_NO_RAY)) & ~s->met, packet, light);
    for (u32 lanes = s->met; lanes; lanes &= lanes - 1u) {
        const u32 i = first_lane(lanes);
        add_light(
            world, light, packet->ids[ID_TAG][i],
            make_rgb(s->p[0][i] * s->n[0][i], s->p[1][i] * s->n[1][i], s->p[2][i] * s->n[2][i] + s->t[i] + s->err[i]));
    }
}
