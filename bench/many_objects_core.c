/* The kernels' core for fields of spheres (bench/corpus.py), in float, counting the nodes of the tree that it opens. */
#define CLU_SPHERE
#define CLU_TRANSPARENT
#define CLU_LIGHTS
#define CLU_LIGHT_PAPER
#define CLU_SKY_RGB
#define CLU_INTERIOR_CAPACITY 64
#define CLU_STACK_CAPACITY 32
#define CLU_GROUP_CAPACITY 1
#define CLU_WALK_CAPACITY 128
#define CLU_ONLY_RENDER
#define NODE_OPENED(world, rays) (nodes_opened += (rays))

unsigned long nodes_opened;

#include "kernels/native.c"
