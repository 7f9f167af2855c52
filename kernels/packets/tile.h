/* How many pixels a block of packets has on a side: to kernels and to the host. */
#ifndef CLUCIDA_PACKETS_TILE_H
#define CLUCIDA_PACKETS_TILE_H

#define PACKET_TILE 16u

#endif
