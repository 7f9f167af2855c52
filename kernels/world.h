/* The scene as a work-item sees it: its buffers, and its own counters. */
#ifndef CLUCIDA_WORLD_H
#define CLUCIDA_WORLD_H

#include "kernels/layout.h"
#include "kernels/unit.h"

#ifdef CLU_SIGNATURE
/* A path's events: how many there were, their hash, the first of them, and the first rays that they began with. */
typedef struct {
    u32 count, hash, capacity, ray_capacity;
    __global LayoutEvent* log;
    __global real* rays; /* RAY_NUMBERS of each */
} Signature;
#endif

typedef struct {
    __global const LayoutFrame* frame;
    __global const LayoutNode* nodes;
    __global const LayoutObject* objects;
    __global const LayoutGroup* groups;
    __global const u32* members;
    __global const u32* programs;
    __global const LayoutPlane* planes;
    __global const LayoutPlaneBlock* blocks;
    __global const LayoutSphere* spheres;
    __global const LayoutQuadric* quadrics;
    __global const LayoutTorus* tori;
    __global const LayoutOptics* optics;
    __global const LayoutTexture* textures;
    __global const LayoutImage* images;
    __global const u32* texels;
    __global const LayoutLight* lights;
    u32 stats[STAT_COUNT];
#ifdef CLU_SIGNATURE
    Signature signature;
#endif
} World;

#define VACUUM 0xffffffffu /* as a medium: of lower precedence than any object */

#define COUNT(world, stat) ((world)->stats[stat]++)

/* A ray. It may have left a surface: then left names the primitive and left_inside tells on which side of it the ray
 * goes (known from the event, never recomputed). err bounds the error of o's distance from any surface it lies on. */
typedef struct {
    vec o, d;
    real excess; /* |d|^2 - 1, which is 0 but for rounding */
    u32 left;
    int left_inside;
    real err;
} Ray;

#endif
