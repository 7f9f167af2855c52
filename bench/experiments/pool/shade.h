/* What becomes of a packet's rays: each lane's surface on its own, by the product's functions; then what optics makes
 * of it, all lanes together (as trace_segment has it for one ray, kernels/trace.h). */
#ifndef POOL_SHADE_H
#define POOL_SHADE_H

#include "kernels/stacks.h"
#include "kernels/trace.h"

/* The packet's surfaces, lane by lane. Masks are ints. */
typedef struct {
    float facing[3][POOL_WIDTH], p[3][POOL_WIDTH];
    float cosine[POOL_WIDTH], t[POOL_WIDTH], err[POOL_WIDTH];
    float w[POOL_WIDTH]; /* the ratio of the indices */
    float reflection[3][POOL_WIDTH], refraction[3][POOL_WIDTH], extinction[3][POOL_WIDTH];
    u32 left[POOL_WIDTH], before[POOL_WIDTH], after[POOL_WIDTH]; /* media as MEDIUM_* has them */
    int beyond_inside[POOL_WIDTH], fresnel[POOL_WIDTH];
    int transparent[POOL_WIDTH];                         /* there is refraction, or total reflection */
    int before_open[POOL_WIDTH], after_open[POOL_WIDTH]; /* the medium is not opaque */
} Shading;

/* The scalar searches are calls: they would crowd the packets' code out of registers and make compilation long. They
 * get copies of the world, so that the packets' own need not lie in memory. */
static CALLED int scalar_surface(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    return next_surface(world, ray, medium, surface);
}

INLINED int surface_by_scalar(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    World copy = *world;
    const Ray same = *ray;
    Surface found;
    const u32 queries = world->stats[STAT_QUERIES];
    const int met = scalar_surface(&copy, &same, medium, &found);
    take_counts(world, &copy);
    world->stats[STAT_QUERIES] = queries + 1u; /* however many the full search makes of it */
    *surface = found;
    return met;
}

#ifdef CLU_LIGHTS
static CALLED void scalar_absorbed(World* world, const Surface* s, rgb filter, rgb* sum)
{
    u32 lit = 0;
    *sum = absorbed(world, s, filter, &lit);
}

INLINED rgb absorbed_by_scalar(World* world, const Surface* s, rgb filter)
{
    World copy = *world;
    const Surface same = *s;
    rgb sum;
    scalar_absorbed(&copy, &same, filter, &sum);
    take_counts(world, &copy);
    return sum;
}
#endif

INLINED Ray lane_ray(const Packet* packet, u32 lane)
{
    Ray ray;
    ray.o = make_vec(packet->row[ROW_OX][lane], packet->row[ROW_OY][lane], packet->row[ROW_OZ][lane]);
    ray.d = make_vec(packet->row[ROW_DX][lane], packet->row[ROW_DY][lane], packet->row[ROW_DZ][lane]);
    ray.excess = packet->row[ROW_EXCESS][lane];
    ray.left = as_uint(packet->row[ROW_LEFT][lane]);
    ray.left_inside = as_int(packet->row[ROW_LEFT_INSIDE][lane]) != 0;
    ray.err = packet->row[ROW_ERR][lane];
    return ray;
}

/* A lane's hit, as the search leaves it. */
typedef struct {
    float t[POOL_WIDTH];
    u32 object[POOL_WIDTH], face[POOL_WIDTH], after[POOL_WIDTH];
} LaneHits;

/* The end of the solid that the full search would have found there: as confirm (kernels/quick.h). */
INLINED int confirm_lane(const World* world, const Ray* ray, u32 medium, float t, u32 object, u32 face,
                         Crossing* crossing)
{
    const Line line = make_line(ray, &world->objects[object]);
    const Span span = member_span(world, face & ~MEMBER_INVERSE, &line);
    const int keeps = (span.keep != 0) != ((face & MEMBER_INVERSE) != 0u), at_lo = keeps == (object != medium);
    crossing->at = at_lo ? span.lo : span.hi;
    crossing->slope = at_lo ? span.slope_lo : span.slope_hi;
    crossing->face = face;
    crossing->t = crossing->at - line.start;
    crossing->err = crossing_error(&line, crossing);
    return fabs(crossing->t - t) < 1e-3f * fmax(1.0f, crossing->t);
}

/* What a lane's ray meets: 0 if nothing. */
INLINED int lane_surface(World* world, const Ray* ray, u32 medium, const LaneHits* hits, u32 lane, Surface* s)
{
    const u32 object = hits->object[lane];
    if (object == OBJECT_NONE) return 0;
    Crossing c;
    if (object == OBJECT_UNSURE || !confirm_lane(world, ray, medium, hits->t[lane], object, hits->face[lane], &c))
        return surface_by_scalar(world, ray, medium, s);
    const real left = c.t <= CLEAR * ray->err ? ray->err : R(0);
    *s = make_surface(world, ray, object, c, left, medium, hits->after[lane]);
    return 1;
}

INLINED void put_lane(float rows[3][POOL_WIDTH], u32 lane, float x, float y, float z)
{
    rows[0][lane] = x;
    rows[1][lane] = y;
    rows[2][lane] = z;
}

INLINED int is_open(const World* world, u32 medium)
{
    return medium == VACUUM || index_of(world, medium) != R(0) ? -1 : 0;
}

/* Keeps what of the surface the wide part needs. */
INLINED void keep_surface(const World* world, Shading* h, u32 lane, const Surface* s, u32 medium, const Finish* finish)
{
    put_lane(h->facing, lane, s->facing.x, s->facing.y, s->facing.z);
    put_lane(h->p, lane, s->p.x, s->p.y, s->p.z);
    h->cosine[lane] = s->cosine;
    h->t[lane] = s->t;
    h->err[lane] = s->err;
    h->left[lane] = s->left;
    h->beyond_inside[lane] = s->beyond_inside ? -1 : 0;
    h->before[lane] = as_medium(medium);
    h->after[lane] = as_medium(s->after);
    h->before_open[lane] = is_open(world, medium);
    h->after_open[lane] = is_open(world, s->after);
    h->transparent[lane] = finish->index > R(0) ? -1 : 0;
    h->w[lane] = h->transparent[lane] ? index_of(world, s->before) / index_of(world, s->after) : R(0);
    h->fresnel[lane] = finish->flags & OPTICS_FRESNEL ? -1 : 0;
    rgb reflection = finish->reflection;
#ifdef CLU_AS_GUN
    if (h->transparent[lane] && !s->entering) reflection = rgb_scale(reflection, R(0.9f));
#endif
    put_lane(h->reflection, lane, reflection.r, reflection.g, reflection.b);
    put_lane(h->refraction, lane, finish->refraction.r, finish->refraction.g, finish->refraction.b);
#ifdef CLU_EXTINCTION
    const rgb e = medium == VACUUM ? grey(R(0)) : load_rgb(world->optics[world->objects[medium].optics].extinction);
    put_lane(h->extinction, lane, e.r, e.g, e.b);
#endif
}

/* One lane up to where its ray goes on. Returns 0 if it does not: what it has seen is then added. */
INLINED int shade_lane(World* world, Shading* h, u32 lane, const Packet* packet, const LaneHits* hits, TileLight* light)
{
    const Ray ray = lane_ray(packet, lane);
    const u32 medium = lane_medium(packet, lane), pixel = as_uint(packet->row[ROW_TAG][lane]) & PIXEL_MASK;
    const rgb weight = lane_color(packet, ROW_WEIGHT, lane);
    Surface s;
    COUNT(world, STAT_RAYS);
    if (!lane_surface(world, &ray, medium, hits, lane, &s)) {
        add_light(light, pixel, rgb_filter(weight, sky_through(world, medium, ray.d)));
        return 0;
    }
    const Finish finish = finish_at(world, shown_object(world, &s), &s);
#ifdef CLU_EMISSION
    if (finish.index < R(0)) {
        const rgb arriving = rgb_filter(weight, transmittance(world, medium, s.t));
        add_light(light, pixel, rgb_filter(arriving, finish.refraction));
        return 0;
    }
#endif
#ifdef CLU_LIGHTS
    if (medium == VACUUM) add_light(light, pixel, rgb_filter(weight, absorbed_by_scalar(world, &s, finish.absorption)));
#endif
    keep_surface(world, h, lane, &s, medium, &finish);
    return 1;
}

typedef struct {
    vreal r, g, b;
} vrgb;

INLINED vrgb load_lanes(const float rows[3][POOL_WIDTH])
{
    vrgb c;
    c.r = LOAD(0, rows[0]);
    c.g = LOAD(0, rows[1]);
    c.b = LOAD(0, rows[2]);
    return c;
}
INLINED vvec load_vecs(const float rows[3][POOL_WIDTH])
{
    vvec v;
    v.x = LOAD(0, rows[0]);
    v.y = LOAD(0, rows[1]);
    v.z = LOAD(0, rows[2]);
    return v;
}
INLINED vrgb vfilter(vrgb a, vrgb b)
{
    a.r *= b.r;
    a.g *= b.g;
    a.b *= b.b;
    return a;
}
INLINED vrgb vrgb_scaled(vrgb a, vreal s)
{
    a.r *= s;
    a.g *= s;
    a.b *= s;
    return a;
}

/* Pushes the rays that leave the surfaces in directions d, but those that are black by rule. */
INLINED void push_rays(World* world, Stacks* stacks, vint which, const Shading* h, u32 refracted, vvec d, vrgb filter,
                       vrgb weight, const Packet* from)
{
    vrgb throughput;
    throughput.r = LOAD(0, from->row[ROW_THROUGHPUT]);
    throughput.g = LOAD(0, from->row[ROW_THROUGHPUT + 1]);
    throughput.b = LOAD(0, from->row[ROW_THROUGHPUT + 2]);
    throughput = vfilter(throughput, filter);
    weight = vfilter(weight, filter);
    const vreal most = fmax(throughput.r, fmax(throughput.g, throughput.b));
    const vword tag = AS_WORDS(LOAD(0, from->row[ROW_TAG])) - (1u << PIXEL_BITS);
    const vint go = which & ~(most < world->frame->cutoff) & ~(most <= 0.0f) & (vint)(tag > PIXEL_MASK);
    if (!any_lane(go)) return;
    Packet rays;
    put_vec(&rays, ROW_OX, load_vecs(h->p));
    put_vec(&rays, ROW_DX, d);
    STORE(vexcess(d), 0, rays.row[ROW_EXCESS]);
    STORE(LOAD(0, h->err), 0, rays.row[ROW_ERR]);
    STORE(AS_REALS(LOAD(0, h->left)), 0, rays.row[ROW_LEFT]);
    const vint beyond = LOAD(0, h->beyond_inside);
    STORE(AS_REALS(refracted ? beyond : ~beyond), 0, rays.row[ROW_LEFT_INSIDE]);
    STORE(AS_REALS(LOAD(0, refracted ? h->after : h->before)), 0, rays.row[ROW_MEDIUM]);
    STORE(AS_REALS(tag), 0, rays.row[ROW_TAG]);
    STORE(throughput.r, 0, rays.row[ROW_THROUGHPUT]);
    STORE(throughput.g, 0, rays.row[ROW_THROUGHPUT + 1]);
    STORE(throughput.b, 0, rays.row[ROW_THROUGHPUT + 2]);
    STORE(weight.r, 0, rays.row[ROW_WEIGHT]);
    STORE(weight.g, 0, rays.row[ROW_WEIGHT + 1]);
    STORE(weight.b, 0, rays.row[ROW_WEIGHT + 2]);
    push_packet(world, stacks, &rays, go, refracted);
}

/* Refraction as kernels/optics.h has it: det, less than 0 for total reflection, and the direction. */
#if defined(CLU_AS_GUN) || defined(CLU_AS_RAYT)
INLINED vreal vrefraction_det(vreal w, vreal cosine)
{
    const vreal a = w * cosine, det = 1.0f - w * w * (1.0f - a * a);
    return CHOOSE(det < LEAST_DET, ALL(-1.0f), det);
}
INLINED vvec vrefracted(vvec d, vvec n, vreal w, vreal cosine, vreal det)
{
    return vunit(valong(vscaled(d, w), n, w * w * cosine - sqrt(det)));
}
#else
INLINED vreal vrefraction_det(vreal w, vreal cosine)
{
    const vreal wa = w * cosine;
    return fma(wa, wa, (1.0f - w) * (1.0f + w));
}
INLINED vvec vrefracted(vvec d, vvec n, vreal w, vreal cosine, vreal det)
{
    const vreal s = fma(w, cosine, sqrt(det));
    const vint straight = (w == 1.0f) | (s == 0.0f);
    const vvec out = vrenormalized(valong(vscaled(d, w), n, (w - 1.0f) * (w + 1.0f) / s));
    d.x = CHOOSE(straight, d.x, out.x);
    d.y = CHOOSE(straight, d.y, out.y);
    d.z = CHOOSE(straight, d.z, out.z);
    return d;
}
#endif

#ifdef CLU_FRESNEL
INLINED vreal vreflectance(vreal w, vreal cosine, vreal det)
{
    const vreal other = sqrt(det);
    const vreal s = (w * cosine - other) / (w * cosine + other), p = (w * other - cosine) / (w * other + cosine);
    const vreal r = 0.5f * (s * s + p * p);
    return CHOOSE(w == 1.0f, ALL(0.0f), CHOOSE(r == r, r, ALL(1.0f)));
}
#endif

/* The refracted rays. *reflection becomes what Fresnel's weights or total reflection make of it. */
INLINED void shade_refraction(World* world, Stacks* stacks, vint met, const Shading* h, vvec d, vrgb* reflection,
                              vrgb weight, const Packet* packet)
{
    const vint transparent = met & LOAD(0, h->transparent);
    if (!any_lane(transparent)) return;
    const vreal w = LOAD(0, h->w), cosine = LOAD(0, h->cosine), det = vrefraction_det(w, cosine);
    const vint passes = transparent & (det >= 0.0f);
    vrgb filter = load_lanes(h->refraction);
#ifndef CLU_AS_GUN
    const vint total = transparent & ~passes;
    reflection->r = CHOOSE(total, fmin(reflection->r + filter.r, ALL(1.0f)), reflection->r);
    reflection->g = CHOOSE(total, fmin(reflection->g + filter.g, ALL(1.0f)), reflection->g);
    reflection->b = CHOOSE(total, fmin(reflection->b + filter.b, ALL(1.0f)), reflection->b);
#endif
    const vreal root = fmax(det, ALL(0.0f));
#ifdef CLU_FRESNEL
    const vint weighed = passes & LOAD(0, h->fresnel);
    const vreal reflectance = vreflectance(w, cosine, root);
    filter = vrgb_scaled(filter, CHOOSE(weighed, 1.0f - reflectance, ALL(1.0f)));
    *reflection = vrgb_scaled(*reflection, CHOOSE(weighed, reflectance, ALL(1.0f)));
#endif
    const vvec out = vrefracted(d, load_vecs(h->facing), w, cosine, root);
    push_rays(world, stacks, passes & LOAD(0, h->after_open), h, 1, out, filter, weight, packet);
}

INLINED void shade_reflection(World* world, Stacks* stacks, vint met, const Shading* h, vvec d, vrgb reflection,
                              vrgb weight, const Packet* packet)
{
    const vint open = met & LOAD(0, h->before_open);
    if (!any_lane(open)) return;
    const vvec facing = load_vecs(h->facing);
    const vreal twice = 2.0f * LOAD(0, h->cosine);
    const vvec out = vrenormalized(valong(d, facing, fma(-twice, vexcess(facing), twice)));
    push_rays(world, stacks, open, h, 0, out, reflection, weight, packet);
}

INLINED void shade_packet(World* world, Stacks* stacks, const Packet* packet, const LaneHits* hits, TileLight* light)
{
    Shading h;
    int lanes[POOL_WIDTH];
    for (u32 i = 0; i < POOL_WIDTH; i++)
        lanes[i] = has_ray(packet, i) && shade_lane(world, &h, i, packet, hits, light) ? -1 : 0;
    const vint met = LOAD(0, lanes);
    if (!any_lane(met)) return;
    const vvec d = packet_vec(packet, ROW_DX);
    vrgb reflection = load_lanes(h.reflection), weight;
    weight.r = LOAD(0, packet->row[ROW_WEIGHT]);
    weight.g = LOAD(0, packet->row[ROW_WEIGHT + 1]);
    weight.b = LOAD(0, packet->row[ROW_WEIGHT + 2]);
#ifdef CLU_EXTINCTION
    const vrgb e = load_lanes(h.extinction);
    if (any_lane(met & ((e.r != 0.0f) | (e.g != 0.0f) | (e.b != 0.0f)))) {
        const vreal t = LOAD(0, h.t);
        weight.r *= exp(-e.r * t);
        weight.g *= exp(-e.g * t);
        weight.b *= exp(-e.b * t);
    }
#endif
#ifdef CLU_TRANSPARENT
    shade_refraction(world, stacks, met, &h, d, &reflection, weight, packet);
#endif
    shade_reflection(world, stacks, met, &h, d, reflection, weight, packet);
}

#endif
