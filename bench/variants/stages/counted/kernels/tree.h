/* The nodes that a walk opens count as silent crossings, once for each ray: no counter is to spare. */
#define NODE_OPENED(world, rays) (((World*)(world))->stats[STAT_SILENT] += (rays))
#include "full/kernels/tree.h"
