/* How the boxes of a node's children are stored. */
#ifndef CLUCIDA_NODE_H
#define CLUCIDA_NODE_H

#include "kernels/layout.h"
#include "kernels/wide.h"

/* The k-th bound (LayoutNode) of all children. */
INLINED wide node_bounds(__global const LayoutNode* node, u32 k)
{
    return load_wide(node->bounds[k]);
}

/* That of one child. */
INLINED real node_bound(__global const LayoutNode* node, u32 k, u32 child)
{
    return R(node->bounds[k][child]);
}

#endif
