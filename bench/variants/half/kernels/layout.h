/* The boxes of nodes in half precision. */
#define LayoutNode LayoutFloatNode
#include "full/kernels/layout.h"
#undef LayoutNode
#ifndef CLUCIDA_HALF_NODE_H
#define CLUCIDA_HALF_NODE_H

/* As LayoutNode has it; a bound is rounded outward to a half. 128 bytes: two lines of the cache. */
typedef struct {
    unsigned short bounds[6][8];
    u32 child[8];
} LayoutNode;

#endif
