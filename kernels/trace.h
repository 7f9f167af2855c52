/* What arrives along a ray. Tracing is linear in throughput, so recursion is a loop: of the two branches at a surface
 * one goes on and the other waits on a stack. Deterministic: every branch above the cutoff is followed. */
#ifndef CLUCIDA_TRACE_H
#define CLUCIDA_TRACE_H

#include "kernels/hidden.h"
#include "kernels/optics.h"
#include "kernels/signature.h"
#include "kernels/sky.h"
#include "kernels/surface.h"

/* A ray to be traced, and what becomes of the light that it brings. */
typedef struct {
    Ray ray;
    rgb throughput; /* the product of the surface filters since the observer: decides the cutoff */
    rgb weight;     /* throughput times what the media let through */
    u32 hops;       /* segments left, this one included */
    u32 medium;     /* in force at the ray's start: an object or VACUUM */
} Branch;

/* A surface's optics at one point. */
typedef struct {
    rgb reflection, absorption, refraction;
    real index;
    u32 flags;
} Finish;

INLINED real index_of(const World* world, u32 medium)
{
    return medium == VACUUM ? R(1) : R(world->optics[world->objects[medium].optics].index);
}

#ifdef CLU_MEDIA_RANK
/* rayt's rule: the medium outside the crossed object gives its optics where its rank is under half of the object's. */
INLINED u32 ranked_object(const World* world, const Surface* s)
{
    const u32 outside = s->entering ? s->before : s->after;
    if (outside == VACUUM || !(index_of(world, s->object) > R(0)) || !(index_of(world, outside) > R(0)))
        return s->object;
    const float own = world->optics[world->objects[s->object].optics].rank;
    const float other = world->optics[world->objects[outside].optics].rank;
    return R(other) < R(own) * R(0.5f) ? outside : s->object;
}
#endif

/* Whose optics show: the crossed object's, but an opaque or emitting medium beyond shows its own. */
INLINED u32 shown_object(const World* world, const Surface* s)
{
    if (s->after != VACUUM && !(index_of(world, s->after) > R(0)) && !(index_of(world, s->object) < R(0)))
        return s->after;
#ifdef CLU_MEDIA_RANK
    if (world->frame->media_rule == MEDIA_RANK) return ranked_object(world, s);
#endif
    return s->object;
}

INLINED Finish finish_at(const World* world, u32 id, const Surface* s)
{
    __global const LayoutOptics* optics = &world->optics[world->objects[id].optics];
    Finish f;
    f.reflection = unpack_filter(optics->reflection);
    f.absorption = unpack_filter(optics->absorption);
    f.refraction = unpack_filter(optics->refraction);
    f.index = R(optics->index);
    f.flags = optics->flags;
#ifdef CLU_TEXTURE
    if (world->objects[id].texture != TEXTURE_NONE && f.index >= R(0)) {
        const LayoutTexture texture = world->textures[world->objects[id].texture];
        const rgb photo = texture_color(world, &texture, s->p, s->n);
        f.reflection = rgb_saturate(rgb_add(f.reflection, rgb_filter(photo, unpack_filter(texture.reflection))));
        f.absorption = rgb_saturate(rgb_add(f.absorption, rgb_filter(photo, unpack_filter(texture.absorption))));
        f.refraction = rgb_saturate(rgb_add(f.refraction, rgb_filter(photo, unpack_filter(texture.refraction))));
    }
#else
    (void)s;
#endif
    return f;
}

/* What the medium in force at the ray's start lets through over the distance. */
INLINED rgb transmittance(const World* world, u32 medium, real distance)
{
#ifdef CLU_EXTINCTION
    if (medium != VACUUM) {
        const rgb e = load_rgb(world->optics[world->objects[medium].optics].extinction);
        return make_rgb(decay(e.r * distance), decay(e.g * distance), decay(e.b * distance));
    }
#else
    (void)world;
    (void)medium;
    (void)distance;
#endif
    return grey(R(1));
}

/* The sky, for a ray that meets nothing any more: from within a medium only where that is perfectly clear. */
INLINED rgb sky_through(const World* world, u32 medium, vec d)
{
    rgb sky = sky_color(world, d);
#ifdef CLU_EXTINCTION
    if (medium != VACUUM) {
        const rgb e = load_rgb(world->optics[world->objects[medium].optics].extinction);
#ifdef CLU_AS_RAYT
        if (rgb_largest(e) > R(0)) return grey(R(0));
#endif
        if (e.r > R(0)) sky.r = R(0);
        if (e.g > R(0)) sky.g = R(0);
        if (e.b > R(0)) sky.b = R(0);
    }
#else
    (void)medium;
#endif
    return sky;
}

#ifdef CLU_LIGHTS
/* Light that arrives straight from the lights, times the absorption filter; *lit tells from which. */
INLINED rgb absorbed(World* world, const Surface* s, rgb filter, u32* lit)
{
    __global const LayoutFrame* frame = world->frame;
    rgb sum = grey(R(0));
    if (!(rgb_largest(filter) > R(0))) return sum;
    Ray shadow;
    shadow.o = s->p;
    shadow.left = s->left;
    shadow.left_inside = !s->beyond_inside;
    shadow.err = s->err;
    for (u32 i = 0; i < frame->light_count; i++) {
        const rgb light = rgb_filter(load_rgb(world->lights[i].color), filter);
#ifdef CLU_AS_GUN
        if (rgb_largest(light) < R(frame->cutoff)) continue;
#endif
        const vec to_light = sub(load_vec(world->lights[i].point), s->p);
        const real distance = sqrt(dot3(to_light, to_light));
        if (!(distance > R(0))) continue;
        shadow.d = scaled(to_light, R(1) / distance);
        shadow.excess = length_excess(shadow.d);
        const real cosine = dot3(s->n, shadow.d);
        if (!(cosine > R(0)) || is_hidden(world, &shadow, distance)) continue;
        sum = rgb_add(sum, rgb_scale(light, diffuse(frame->light_law, cosine, distance)));
        *lit |= 1u << (i & 31u);
    }
    return sum;
}
#endif

/* Black by rule: nothing left to see, no hops left, or inside something opaque. Counts what that cuts off. */
INLINED int is_black(World* world, rgb throughput, rgb weight, u32 hops, u32 medium)
{
    const int cut = rgb_largest(throughput) < R(world->frame->cutoff);
    if (rgb_largest(throughput) <= R(0) || (medium != VACUUM && index_of(world, medium) == R(0))) return 1;
    if (!cut && hops > 0) return 0;
    world->stats[cut ? STAT_CUT_BRANCHES : STAT_HOP_BRANCHES]++;
    world->stats[STAT_TRUNCATED] += (u32)(fmin(rgb_largest(weight), R(1)) * R(65536));
    return 1;
}

/* The branch that leaves the surface in direction d, on the near side or beyond. Returns 0 if it would be black. */
INLINED int follow(World* world, Branch* next, const Surface* s, vec d, int beyond, u32 medium, rgb filter,
                   rgb throughput, rgb weight, u32 hops)
{
    next->throughput = rgb_filter(throughput, filter);
    next->weight = rgb_filter(weight, filter);
    next->hops = hops - 1;
    if (is_black(world, next->throughput, next->weight, next->hops, medium)) return 0;
    next->ray.o = s->p;
    next->ray.d = d;
    next->ray.excess = length_excess(d);
    next->ray.left = s->left;
    next->ray.left_inside = beyond ? s->beyond_inside : !s->beyond_inside;
    next->ray.err = s->err;
    next->medium = medium;
    COUNT(world, STAT_RAYS);
    world->stats[beyond ? STAT_REFRACTED : STAT_REFLECTED]++;
    return 1;
}

/* One segment of a branch: adds what it sees to *sum. The branches that follow are left in *branch (returned as
 * EVENT_REFLECTED) and *other (EVENT_REFRACTED). */
INLINED u32 trace_segment(World* world, Branch* branch, Branch* other, rgb* sum)
{
    Surface s;
    LayoutEvent event = {world->frame->max_hops - branch->hops, EVENT_NONE, EVENT_NONE, 0, 0};
    const u32 medium = branch->medium;
    record_ray(world, &branch->ray, branch->throughput);
    if (!next_surface(world, &branch->ray, medium, &s)) {
        record_event(world, event);
        *sum = rgb_add(*sum, rgb_filter(branch->weight, sky_through(world, medium, branch->ray.d)));
        return 0;
    }
    const vec d = branch->ray.d;
    const rgb throughput = branch->throughput;
    const rgb weight = rgb_filter(branch->weight, transmittance(world, medium, s.t));
    const u32 hops = branch->hops;
    const u32 shown = shown_object(world, &s);
    Finish finish = finish_at(world, shown, &s);
    event.object = s.object;
    event.face = s.left;
    event.what = s.entering ? EVENT_ENTERING : 0;
    (void)other;
#ifdef CLU_EMISSION
    if (finish.index < R(0)) {
        event.what |= EVENT_EMITTED;
        record_event(world, event);
        *sum = rgb_add(*sum, rgb_filter(weight, finish.refraction));
        return 0;
    }
#endif
#ifdef CLU_LIGHTS
    if (medium == VACUUM)
        *sum = rgb_add(*sum, rgb_filter(weight, absorbed(world, &s, finish.absorption, &event.lights)));
#endif
#ifdef CLU_TRANSPARENT
    if (finish.index > R(0)) {
        const real w = index_of(world, s.before) / index_of(world, s.after);
        const real det = refraction_det(w, s.cosine);
        if (det >= R(0)) {
            rgb filter = finish.refraction;
#ifdef CLU_FRESNEL
            if (finish.flags & OPTICS_FRESNEL) {
                const real reflectance = fresnel_reflectance(w, s.cosine, det);
                filter = rgb_scale(filter, R(1) - reflectance);
                finish.reflection = rgb_scale(finish.reflection, reflectance);
            }
#endif
            if (follow(world, other, &s, refracted(d, s.facing, w, s.cosine, det), 1, s.after, filter, throughput,
                       weight, hops))
                event.what |= EVENT_REFRACTED;
        } else {
            event.what |= EVENT_TOTAL;
#ifndef CLU_AS_GUN
            finish.reflection = rgb_saturate(rgb_add(finish.reflection, finish.refraction));
#endif
        }
#ifdef CLU_AS_GUN
        if (!s.entering) finish.reflection = rgb_scale(finish.reflection, R(0.9f));
#endif
    }
#endif
    if (follow(world, branch, &s, reflected(d, s.facing, s.cosine), 0, medium, finish.reflection, throughput, weight,
               hops))
        event.what |= EVENT_REFLECTED;
    record_event(world, event);
    return event.what & (EVENT_REFLECTED | EVENT_REFRACTED);
}

/* What arrives along the ray of `branch`, which the trace uses up. */
INLINED rgb trace(World* world, Branch* branch)
{
    rgb sum = grey(R(0));
    if (is_black(world, branch->throughput, branch->weight, branch->hops, branch->medium)) return sum;
    COUNT(world, STAT_RAYS);
    COUNT(world, STAT_PRIMARY);
#if CLU_STACK_CAPACITY > 0
    Branch stack[CLU_STACK_CAPACITY];
    u32 depth = 0;
    for (;;) {
        Branch other;
        const u32 followed = trace_segment(world, branch, &other, &sum);
        if (followed == (EVENT_REFLECTED | EVENT_REFRACTED)) {
            if (depth < CLU_STACK_CAPACITY)
                stack[depth++] = other;
            else
                COUNT(world, STAT_STACK_OVERFLOW);
        } else if (followed == EVENT_REFRACTED) {
            *branch = other;
        } else if (followed == 0) {
            if (depth == 0) return sum;
            *branch = stack[--depth];
        }
    }
#else
    while (trace_segment(world, branch, branch, &sum)) {}
    return sum;
#endif
}

#endif
