/* The kernels' C core as C11, in float or in double (CLU_DOUBLE), or as C++ (native_double.cpp). Compiled with every
 * feature it is what unit tests call; a benchmark compiles it with a scene's own features, and with CLU_ONLY_RENDER:
 * what is called from one place only the compiler inlines there, as it does in the OpenCL kernel. */
#include "kernels/native_api.h"

#include "kernels/packets/trace.h"
#include "kernels/selftest.h"

#include <assert.h>
#include <stddef.h>

#ifdef CLU_FULL_SEARCH
#define NATIVE(name) name##_full
#elif defined(CLU_DOUBLE)
#define NATIVE(name) name##_d
#else
#define NATIVE(name) name##_f
#endif

#if !defined(CLU_ONLY_RENDER) && !defined(CLU_DOUBLE)
const NativeCapacities native_capacities = {CLU_INTERIOR_CAPACITY, CLU_STACK_CAPACITY, CLU_GROUP_CAPACITY,
                                            CLU_WALK_CAPACITY};

void native_selftest(const float in[4], float results[5])
{
    test_arithmetic(in, results);
}
#endif

/* World begins with the buffers, in the order of LayoutBuffer. */
static_assert(offsetof(World, stats) == sizeof(void*) * BUFFER_COUNT, "each buffer has its place in World");
static World make_world(const NativeScene* scene)
{
    World world;
    memset(&world, 0, sizeof world);
    memcpy(&world, scene->buffers, sizeof scene->buffers);
    return world;
}

static void add_stats(const World* world, u32* stats)
{
    for (u32 k = 0; k < STAT_COUNT; k++) stats[k] += world->stats[k];
}

#ifndef CLU_ONLY_RENDER
static vec from_doubles(const double* v)
{
    return make_vec((real)v[0], (real)v[1], (real)v[2]);
}

static void to_doubles(vec v, double* out)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static Ray make_ray(const NativeRay* r)
{
    Ray ray;
    ray.o = from_doubles(r->o);
    ray.d = renormalized(from_doubles(r->d));
    ray.excess = length_excess(ray.d);
    ray.left = r->left;
    ray.left_inside = r->left_inside;
    ray.err = (real)r->err;
    return ray;
}
#endif

void NATIVE(native_render)(const NativeScene* scene, u32 x0, u32 y0, u32 width, u32 height, u32 sample_begin,
                           u32 sample_end, float* rgba, u32* stats)
{
    World world = make_world(scene);
    for (u32 j = 0; j < height; j++) {
        for (u32 i = 0; i < width; i++) {
            float* pixel = rgba + 4 * ((size_t)j * width + i);
            if (sample_begin == 0) pixel[0] = pixel[1] = pixel[2] = pixel[3] = 0;
            for (u32 sample = sample_begin; sample < sample_end; sample++) {
                const rgb color = observe(&world, x0 + i, y0 + j, sample);
                pixel[0] += (float)color.r;
                pixel[1] += (float)color.g;
                pixel[2] += (float)color.b;
            }
        }
    }
    add_stats(&world, stats);
}

void NATIVE(native_render_packets)(const NativeScene* scene, u32 x0, u32 y0, u32 width, u32 height, u32 sample_begin,
                                   u32 sample_end, float* rgba, u32* stats)
{
    World world = make_world(scene);
    for (u32 at_y = 0; at_y < height; at_y += PACKET_TILE) {
        for (u32 at_x = 0; at_x < width; at_x += PACKET_TILE) {
            const PixelBlock block = {x0 + at_x, y0 + at_y, width - at_x < PACKET_TILE ? width - at_x : PACKET_TILE,
                                      height - at_y < PACKET_TILE ? height - at_y : PACKET_TILE};
            TileLight light;
            trace_block(&world, &block, sample_begin, sample_end, &light);
            for (u32 j = 0; j < block.height; j++) {
                for (u32 i = 0; i < block.width; i++) {
                    float* pixel = rgba + 4 * ((size_t)(at_y + j) * width + at_x + i);
                    if (sample_begin == 0) pixel[0] = pixel[1] = pixel[2] = pixel[3] = 0;
                    for (u32 k = 0; k < 3; k++) pixel[k] += (float)light.sums[j * PACKET_TILE + i][k];
                }
            }
        }
    }
    add_stats(&world, stats);
}

#ifndef CLU_ONLY_RENDER
static void tell_surface(const Surface* s, NativeSurface* surface)
{
    surface->t = s->t;
    to_doubles(s->p, surface->p);
    to_doubles(s->n, surface->n);
    surface->object = s->object;
    surface->before = s->before;
    surface->after = s->after;
    surface->err = s->err;
    surface->left = s->left;
    surface->beyond_inside = s->beyond_inside;
}

int NATIVE(native_surface)(const NativeScene* scene, const NativeRay* ray, const u32* inside, u32 count,
                           NativeSurface* surface, u32* stats)
{
    World world = make_world(scene);
    const Ray r = make_ray(ray);
    u32 medium = VACUUM;
    for (u32 i = 0; i < count; i++) medium = inside[i] < medium ? inside[i] : medium;
    Surface s;
    const int found = next_surface(&world, &r, medium, &s);
    add_stats(&world, stats);
    if (found) tell_surface(&s, surface);
    return found;
}

int NATIVE(native_surface_full)(const NativeScene* scene, const NativeRay* ray, u32 medium, NativeSurface* surface,
                                u32* stats)
{
    World world = make_world(scene);
    const Ray r = make_ray(ray);
    Surface s;
    const int found = full_surface(&world, &r, medium, &s);
    add_stats(&world, stats);
    if (found) tell_surface(&s, surface);
    return found;
}

static void tell_lane(const PacketSurfaces* surfaces, u32 lane, NativeSurface* surface)
{
    Surface s = lane_surface(surfaces, lane);
    const u32 face = (u32)surfaces->face[lane];
    s.err = surfaces->err[lane];
    s.left = face & ~MEMBER_INVERSE;
    s.beyond_inside = s.entering != ((face & MEMBER_INVERSE) != 0u);
    tell_surface(&s, surface);
}

void NATIVE(native_surfaces)(const NativeScene* scene, const NativeRay rays[8], const u32 media[8],
                             NativeSurface surfaces[8], int found[8])
{
    World world = make_world(scene);
    Packet packet;
    memset(&packet, 0, sizeof packet);
    for (u32 i = 0; i < LANES; i++) {
        packet.ids[ID_MEDIUM][i] = media[i] == NO_RAY ? MEDIUM_NO_RAY : signed_medium(media[i]);
        if (media[i] == NO_RAY) continue;
        const Ray r = make_ray(&rays[i]);
        const real rows[] = {r.o.x, r.o.y, r.o.z, r.d.x, r.d.y, r.d.z, r.excess, r.err};
        for (u32 k = 0; k < 8; k++) packet.rows[ROW_O + k][i] = rows[k];
        packet.ids[ID_LEFT][i] = (int)r.left;
        packet.ids[ID_LEFT_INSIDE][i] = r.left_inside ? -1 : 0;
    }
    PacketSurfaces s;
    const u32 unsure = sure_surfaces(&world, &packet, &s);
    for (u32 i = 0; i < LANES; i++) {
        found[i] = unsure >> i & 1u ? -1 : (int)(s.met >> i & 1u);
        if (found[i] > 0) tell_lane(&s, i, &surfaces[i]);
    }
}

void NATIVE(native_trace)(const NativeScene* scene, const NativeRay* ray, double rgb_out[3], u32* stats)
{
    World world = make_world(scene);
    Branch branch;
    branch.ray = make_ray(ray);
    branch.throughput = branch.weight = grey(R(1));
    branch.hops = world.frame->max_hops;
    branch.medium = VACUUM;
    const rgb color = trace(&world, &branch);
    rgb_out[0] = color.r;
    rgb_out[1] = color.g;
    rgb_out[2] = color.b;
    add_stats(&world, stats);
}

#ifdef CLU_TRANSPARENT
int NATIVE(native_refract)(const double d[3], const double n[3], double w, double out[3], double* reflectance)
{
    const vec direction = from_doubles(d), normal = from_doubles(n);
    const real cosine = -dot3(direction, normal);
    const real det = refraction_det((real)w, cosine);
    if (!(det >= R(0))) return 0;
    to_doubles(refracted(direction, normal, (real)w, cosine, det), out);
#ifdef CLU_FRESNEL
    *reflectance = fresnel_reflectance((real)w, cosine, det);
#else
    *reflectance = 0;
#endif
    return 1;
}
#endif

void NATIVE(native_reflect)(const double d[3], const double n[3], double out[3])
{
    const vec direction = from_doubles(d), normal = from_doubles(n);
    to_doubles(reflected(direction, normal, -dot3(direction, normal)), out);
}

#ifdef CLU_LIGHTS
double NATIVE(native_diffuse)(u32 law, double cosine, double distance)
{
    return diffuse(law, (real)cosine, (real)distance);
}
#endif

void NATIVE(native_unpack_filter)(u32 packed, double out[3])
{
    const rgb c = unpack_filter(packed);
    out[0] = c.r;
    out[1] = c.g;
    out[2] = c.b;
}
#endif
