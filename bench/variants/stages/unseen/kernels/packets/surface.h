/* No ray meets anything, as in unseen/kernels/surface.h. */
#define packet_surfaces packet_surfaces_seen
#include "full/kernels/packets/surface.h"
#undef packet_surfaces

INLINED void packet_surfaces(World* world, const Packet* packet, PacketSurfaces* s)
{
    (void)world;
    (void)packet;
    s->met = 0;
}
