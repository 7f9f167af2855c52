/* The C core built natively, as unit tests, sanitizers and the native baseline call it, in float (suffix f) and in
 * double (suffix d). With every feature in it has all of these functions; with fewer, those that make sense. Points and
 * directions are doubles that the core takes as its own type; points are relative to the eye, as the buffers are. */
#ifndef CLUCIDA_NATIVE_API_H
#define CLUCIDA_NATIVE_API_H

#include "kernels/layout.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The scene's buffers in the order of LayoutBuffer; an empty one may be null. */
typedef struct {
    const void* buffers[BUFFER_COUNT];
} NativeScene;

/* What a scene may need at most, as scene::Needs counts it. */
typedef struct {
    u32 interior, stack, groups, walk;
} NativeCapacities;
extern const NativeCapacities native_capacities;
/* kernels/selftest.h */
void native_selftest(const float in[4], float results[5]);

/* A ray, and the primitive that it leaves (MEMBER_NONE: none). err is that of the surface it leaves, else 0. */
typedef struct {
    double o[3], d[3];
    u32 left;
    int left_inside;
    double err;
} NativeRay;

typedef struct {
    double t, p[3], n[3];
    u32 object, before, after; /* 0xffffffff: vacuum */
    u32 left;
    int beyond_inside;
    double err; /* how far p may lie from the boundaries crossed there */
} NativeSurface;

/* Samples sample_begin..sample_end-1 of the pixels x0..x0+width-1, y0..y0+height-1 (all within the picture): their
 * sums of r, g, b, 0 are added to rgba, row by row, or begin it anew from sample 0 on; counters are added to
 * stats[STAT_COUNT]. */
void native_render_f(const NativeScene* scene, u32 x0, u32 y0, u32 width, u32 height, u32 sample_begin, u32 sample_end,
                     float* rgba, u32* stats);
void native_render_d(const NativeScene* scene, u32 x0, u32 y0, u32 width, u32 height, u32 sample_begin, u32 sample_end,
                     float* rgba, u32* stats);
/* Likewise by packets of rays. */
void native_render_packets_f(const NativeScene* scene, u32 x0, u32 y0, u32 width, u32 height, u32 sample_begin,
                             u32 sample_end, float* rgba, u32* stats);
void native_render_packets_d(const NativeScene* scene, u32 x0, u32 y0, u32 width, u32 height, u32 sample_begin,
                             u32 sample_end, float* rgba, u32* stats);
/* Likewise in float, by the full search alone. */
void native_render_full(const NativeScene* scene, u32 x0, u32 y0, u32 width, u32 height, u32 sample_begin,
                        u32 sample_end, float* rgba, u32* stats);

/* The next surface of a ray whose origin lies in the given objects (ascending ids). Returns 1, or 0 if there is none.
 * stats: STAT_COUNT counters that are added to. */
int native_surface_f(const NativeScene* scene, const NativeRay* ray, const u32* inside, u32 count,
                     NativeSurface* surface, u32* stats);
int native_surface_d(const NativeScene* scene, const NativeRay* ray, const u32* inside, u32 count,
                     NativeSurface* surface, u32* stats);

/* Likewise by the full search alone, of a ray that starts in the given medium (0xffffffff: vacuum). */
int native_surface_full_f(const NativeScene* scene, const NativeRay* ray, u32 medium, NativeSurface* surface,
                          u32* stats);
int native_surface_full_d(const NativeScene* scene, const NativeRay* ray, u32 medium, NativeSurface* surface,
                          u32* stats);
/* Likewise of eight rays by the search for packets: found is 1, 0 where there is none, -1 where that is not sure. A
 * lane of medium NO_RAY has no ray: found is 0. */
#define NO_RAY 0xfffffffeu
void native_surfaces_f(const NativeScene* scene, const NativeRay rays[8], const u32 media[8], NativeSurface surfaces[8],
                       int found[8]);
void native_surfaces_d(const NativeScene* scene, const NativeRay rays[8], const u32 media[8], NativeSurface surfaces[8],
                       int found[8]);

/* What arrives along a ray from outside every object. */
void native_trace_f(const NativeScene* scene, const NativeRay* ray, double rgb_out[3], u32* stats);
void native_trace_d(const NativeScene* scene, const NativeRay* ray, double rgb_out[3], u32* stats);

/* Refraction of direction d at unit normal n (on the side that d comes from), w = n1/n2. Returns 0 at total
 * reflection. */
int native_refract_f(const double d[3], const double n[3], double w, double out[3], double* reflectance);
int native_refract_d(const double d[3], const double n[3], double w, double out[3], double* reflectance);
/* The mirror's direction. */
void native_reflect_f(const double d[3], const double n[3], double out[3]);
void native_reflect_d(const double d[3], const double n[3], double out[3]);
double native_diffuse_f(u32 law, double cosine, double distance);
double native_diffuse_d(u32 law, double cosine, double distance);
void native_unpack_filter_f(u32 packed, double out[3]);
void native_unpack_filter_d(u32 packed, double out[3]);

#ifdef __cplusplus
}
#endif
#endif
