/* Every search is done once more, as in searched_twice/kernels/quick.h. */
#define packet_search packet_search_once
#include "full/kernels/packets/search.h"
#undef packet_search

INLINED PacketHit packet_search(World* world, const Packet* packet, PacketLine* l)
{
    PacketHit hit;
    for (u32 i = 0; i <= world->frame->samples; i++) hit = packet_search_once(world, packet, l);
    return hit;
}
