/* Boxes stored in half precision: OpenCL C reads halves without any extension. */
#ifndef CLUCIDA_NODE_H
#define CLUCIDA_NODE_H

#include "kernels/layout.h"
#include "kernels/wide.h"

/* The k-th bound (LayoutNode) of all children. */
INLINED wide node_bounds(__global const LayoutNode* node, u32 k)
{
    return vload_half8(0, (__global const half*)node->bounds[k]);
}

/* That of one child. */
INLINED real node_bound(__global const LayoutNode* node, u32 k, u32 child)
{
    return vload_half(child, (__global const half*)node->bounds[k]);
}

#endif
