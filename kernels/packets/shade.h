/* What becomes of a packet's rays: each lane's surface on its own, with the arithmetic of the one-ray kernel; then what
 * optics makes of it, all lanes together (as trace_segment has it for one ray, kernels/trace.h). */
#ifndef CLUCIDA_PACKETS_SHADE_H
#define CLUCIDA_PACKETS_SHADE_H

#include "kernels/hidden.h"
#include "kernels/packets/stacks.h"
#include "kernels/trace.h"

/* What a packet's rays meet, as the search leaves it. */
typedef struct {
    real t[LANES], tolerance[LANES];
    int object[LANES], face[LANES], after[LANES];
    u32 sure; /* bits */
} LaneHits;

/* The packet's surfaces, lane by lane. Truths are -1 or 0. */
typedef struct {
    real facing[3][LANES], p[3][LANES];
    real cosine[LANES], t[LANES], err[LANES];
    real w[LANES]; /* the ratio of the indices */
    real reflection[3][LANES], refraction[3][LANES], extinction[3][LANES];
    int left[LANES], before[LANES], after[LANES]; /* media as MEDIUM_* has them */
    int beyond_inside[LANES], fresnel[LANES];
    int transparent[LANES];                    /* there is refraction, or total reflection */
    int before_open[LANES], after_open[LANES]; /* the medium is not opaque */
#ifdef CLU_LIGHTS
    real n[3][LANES], absorption[3][LANES];
    int lightable[LANES]; /* the lights may reach the surface */
#endif
} Shading;

/* The rays' segment as the search takes it. */
INLINED PacketLine packet_rays(const Packet* packet)
{
    PacketLine l;
    l.o = packet_vec(packet, ROW_O);
    l.d = packet_vec(packet, ROW_D);
    l.err = load_lanes(packet->rows[ROW_ERR]);
    l.left = load_ids(packet->ids[ID_LEFT]);
    l.left_inside = load_ids(packet->ids[ID_LEFT_INSIDE]);
    return l;
}

INLINED LaneHits search_packet(World* world, const Packet* packet)
{
    PacketLine l = packet_rays(packet);
    const PacketHit hit = packet_search(world, load_ids(packet->ids[ID_MEDIUM]), &l);
    LaneHits hits;
    store_wide(hit.t, hits.t);
    store_wide(hit.tolerance, hits.tolerance);
    store_ids(hit.object, hits.object);
    store_ids(hit.face, hits.face);
    store_ids(hit.after, hits.after);
    hits.sure = wide_bits(hit.sure);
    return hits;
}

/* The full searches are calls: they would crowd the packets' code out of registers and make compilation long. They get
 * copies of the world, so that the packets' own need not lie in memory. */
INLINED int surface_in_full(World* world, const Ray* ray, u32 medium, Surface* surface)
{
    World copy = *world;
    const Ray same = *ray;
    Surface found;
    const u32 queries = world->stats[STAT_QUERIES];
    const int met = full_surface(&copy, &same, medium, &found);
    for (u32 i = 0; i < STAT_COUNT; i++) world->stats[i] = copy.stats[i];
    world->stats[STAT_QUERIES] = queries; /* however many the full search makes of it */
    *surface = found;
    return met;
}

/* What a lane's ray meets: 0 if nothing, -1 if the search was not sure of it. */
INLINED int sure_surface(const World* world, const Ray* ray, u32 medium, const LaneHits* hits, u32 lane, Surface* s)
{
    QuickCrossing quick;
    Crossing crossing;
    quick.t = hits->t[lane];
    quick.tolerance = hits->tolerance[lane];
    quick.object = (u32)hits->object[lane];
    quick.face = (u32)hits->face[lane];
    quick.sure = QUICK && (hits->sure >> lane & 1u);
    if (!quick.sure) return -1;
    if (quick.t == INFINITE) return 0;
    if (!confirm(world, ray, &quick, &crossing)) return -1;
    const real left = crossing.t <= CLEAR * ray->err ? ray->err : R(0);
    *s = make_surface(world, ray, quick.object, crossing, left, medium, unsigned_medium(hits->after[lane]));
    return 1;
}

INLINED int lane_surface(World* world, const Ray* ray, u32 medium, const LaneHits* hits, u32 lane, Surface* s)
{
    const int found = sure_surface(world, ray, medium, hits, lane, s);
    return found < 0 ? surface_in_full(world, ray, medium, s) : found;
}

INLINED void put_lane(real rows[3][LANES], u32 lane, real x, real y, real z)
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
    h->left[lane] = (int)s->left;
    h->beyond_inside[lane] = s->beyond_inside ? -1 : 0;
    h->before[lane] = signed_medium(medium);
    h->after[lane] = signed_medium(s->after);
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
#ifdef CLU_LIGHTS
    h->lightable[lane] = medium == VACUUM && rgb_largest(finish->absorption) > R(0) ? -1 : 0;
    put_lane(h->n, lane, s->n.x, s->n.y, s->n.z);
    put_lane(h->absorption, lane, finish->absorption.r, finish->absorption.g, finish->absorption.b);
#endif
}

/* One lane up to where its ray goes on. Returns 0 if it does not: what it has seen is then added. */
INLINED int shade_lane(World* world, Shading* h, u32 lane, const Packet* packet, const LaneHits* hits, TileLight* light)
{
    const Ray ray = lane_ray(packet, lane);
    const u32 medium = unsigned_medium(packet->ids[ID_MEDIUM][lane]);
    const int tag = packet->ids[ID_TAG][lane];
    const rgb weight = lane_color(packet, ROW_WEIGHT, lane);
    Surface s;
    if (!lane_surface(world, &ray, medium, hits, lane, &s)) {
        add_light(world, light, tag, rgb_filter(weight, sky_through(world, medium, ray.d)));
        return 0;
    }
    const Finish finish = finish_at(world, shown_object(world, &s), &s);
#ifdef CLU_EMISSION
    if (finish.index < R(0)) {
        const rgb arriving = rgb_filter(weight, transmittance(world, medium, s.t));
        add_light(world, light, tag, rgb_filter(arriving, finish.refraction));
        return 0;
    }
#endif
    keep_surface(world, h, lane, &s, medium, &finish);
    return 1;
}

typedef struct {
    wide r, g, b;
} wide_rgb;

/* Three rows of lanes, one after the other. */
INLINED wide_rgb load_colors(const real* rows)
{
    wide_rgb c;
    c.r = load_lanes(rows);
    c.g = load_lanes(rows + LANES);
    c.b = load_lanes(rows + 2 * LANES);
    return c;
}
INLINED wide_vec load_vecs(const real* rows)
{
    return make_wide_vec(load_lanes(rows), load_lanes(rows + LANES), load_lanes(rows + 2 * LANES));
}
INLINED wide_rgb wide_filter(wide_rgb a, wide_rgb b)
{
    a.r *= b.r;
    a.g *= b.g;
    a.b *= b.b;
    return a;
}
INLINED wide_rgb wide_rgb_scaled(wide_rgb a, wide s)
{
    a.r *= s;
    a.g *= s;
    a.b *= s;
    return a;
}
INLINED wide wide_rgb_largest(wide_rgb a)
{
    return wide_larger(a.r, wide_larger(a.g, a.b));
}

/* Counts branches that the cutoff or the hop limit ends, and what light they might have brought. */
INLINED void count_cut(World* world, u32 stat, wide_mask cut, wide_rgb weight)
{
    u32 bits = wide_bits(cut);
    if (!bits) return;
    world->stats[stat] += count_bits(bits);
    real lanes[LANES];
    store_wide(wide_smaller(wide_rgb_largest(weight), wide_all(R(1))) * R(65536), lanes);
    for (; bits; bits &= bits - 1u) world->stats[STAT_TRUNCATED] += (u32)lanes[first_lane(bits)];
}

/* Pushes the rays that leave the surfaces in directions d, but those that are black by rule (is_black). */
INLINED void push_rays(World* world, PacketStacks* stacks, wide_mask which, const Shading* h, u32 refracted, wide_vec d,
                       wide_rgb filter, wide_rgb weight, const Packet* from)
{
    const wide_rgb throughput = wide_filter(load_colors(from->rows[ROW_THROUGHPUT]), filter);
    weight = wide_filter(weight, filter);
    const wide most = wide_rgb_largest(throughput);
    const wide_id tag = load_ids(from->ids[ID_TAG]) - all_ids(1 << PIXEL_BITS);
    const wide_mask some = which & (most > wide_all(R(0)));
    const wide_mask cut = some & (most < wide_all(R(world->frame->cutoff)));
    const wide_mask last = some & ~cut & ~(tag > all_ids((int)PIXEL_MASK));
    count_cut(world, STAT_CUT_BRANCHES, cut, weight);
    count_cut(world, STAT_HOP_BRANCHES, last, weight);
    const u32 go = wide_bits(some & ~cut & ~last);
    if (!go) return;
    Packet rays;
    put_vec(&rays, ROW_O, load_vecs(h->p[0]));
    put_vec(&rays, ROW_D, d);
    store_wide(wide_length_excess(d), rays.rows[ROW_EXCESS]);
    store_wide(load_lanes(h->err), rays.rows[ROW_ERR]);
    store_ids(load_ids(h->left), rays.ids[ID_LEFT]);
    const wide_mask beyond = load_ids(h->beyond_inside);
    store_ids(refracted ? beyond : ~beyond, rays.ids[ID_LEFT_INSIDE]);
    store_ids(load_ids(refracted ? h->after : h->before), rays.ids[ID_MEDIUM]);
    store_ids(tag, rays.ids[ID_TAG]);
    store_wide(throughput.r, rays.rows[ROW_THROUGHPUT]);
    store_wide(throughput.g, rays.rows[ROW_THROUGHPUT + 1]);
    store_wide(throughput.b, rays.rows[ROW_THROUGHPUT + 2]);
    store_wide(weight.r, rays.rows[ROW_WEIGHT]);
    store_wide(weight.g, rays.rows[ROW_WEIGHT + 1]);
    store_wide(weight.b, rays.rows[ROW_WEIGHT + 2]);
    push_packet(world, stacks, &rays, go, refracted);
}

#ifdef CLU_TRANSPARENT
/* Refraction as kernels/optics.h has it: det, less than 0 for total reflection, and the direction. */
#if defined(CLU_AS_GUN) || defined(CLU_AS_RAYT)
INLINED wide wide_refraction_det(wide w, wide cosine)
{
    const wide a = w * cosine, det = R(1) - w * w * (R(1) - a * a);
    return where(det < wide_all(LEAST_DET), wide_all(R(-1)), det);
}
INLINED wide_vec wide_refracted(wide_vec d, wide_vec n, wide w, wide cosine, wide det)
{
    return wide_unit(wide_along(wide_scaled(d, w), n, w * w * cosine - wide_sqrt(det)));
}
#else
INLINED wide wide_refraction_det(wide w, wide cosine)
{
    const wide wa = w * cosine;
    return wide_fma(wa, wa, (R(1) - w) * (R(1) + w));
}
INLINED wide_vec wide_refracted(wide_vec d, wide_vec n, wide w, wide cosine, wide det)
{
    const wide s = wide_fma(w, cosine, wide_sqrt(det));
    const wide_mask straight = (w == wide_all(R(1))) | (s == wide_all(R(0)));
    const wide_vec out = wide_renormalized(wide_along(wide_scaled(d, w), n, (w - R(1)) * (w + R(1)) / s));
    return make_wide_vec(where(straight, d.x, out.x), where(straight, d.y, out.y), where(straight, d.z, out.z));
}
#endif

#ifdef CLU_FRESNEL
INLINED wide wide_reflectance(wide w, wide cosine, wide det)
{
    const wide other = wide_sqrt(det), one = wide_all(R(1));
    const wide s = (w * cosine - other) / (w * cosine + other), p = (w * other - cosine) / (w * other + cosine);
    const wide r = R(0.5f) * (s * s + p * p);
    return where(w == one, wide_all(R(0)), where(r == r, r, one));
}
#endif

/* The refracted rays. *reflection becomes what Fresnel's weights or total reflection make of it. */
INLINED void shade_refraction(World* world, PacketStacks* stacks, wide_mask met, const Shading* h, wide_vec d,
                              wide_rgb* reflection, wide_rgb weight, const Packet* packet)
{
    const wide one = wide_all(R(1)), zero = wide_all(R(0));
    const wide_mask transparent = met & load_ids(h->transparent);
    if (!any_lane(transparent)) return;
    const wide w = load_lanes(h->w), cosine = load_lanes(h->cosine), det = wide_refraction_det(w, cosine);
    const wide_mask passes = transparent & (det >= zero);
    wide_rgb filter = load_colors(h->refraction[0]);
#ifndef CLU_AS_GUN
    const wide_mask total = transparent & ~passes;
    reflection->r = where(total, wide_smaller(reflection->r + filter.r, one), reflection->r);
    reflection->g = where(total, wide_smaller(reflection->g + filter.g, one), reflection->g);
    reflection->b = where(total, wide_smaller(reflection->b + filter.b, one), reflection->b);
#endif
    const wide root = wide_larger(det, zero);
#ifdef CLU_FRESNEL
    const wide_mask weighed = passes & load_ids(h->fresnel);
    const wide reflectance = wide_reflectance(w, cosine, root);
    filter = wide_rgb_scaled(filter, where(weighed, one - reflectance, one));
    *reflection = wide_rgb_scaled(*reflection, where(weighed, reflectance, one));
#endif
    const wide_vec out = wide_refracted(d, load_vecs(h->facing[0]), w, cosine, root);
    push_rays(world, stacks, passes & load_ids(h->after_open), h, 1, out, filter, weight, packet);
}
#endif

INLINED void shade_reflection(World* world, PacketStacks* stacks, wide_mask met, const Shading* h, wide_vec d,
                              wide_rgb reflection, wide_rgb weight, const Packet* packet)
{
    const wide_mask open = met & load_ids(h->before_open);
    if (!any_lane(open)) return;
    const wide_vec facing = load_vecs(h->facing[0]);
    const wide twice = R(2) * load_lanes(h->cosine);
    const wide_vec out = wide_renormalized(wide_along(d, facing, wide_fma(-twice, wide_length_excess(facing), twice)));
    push_rays(world, stacks, open, h, 0, out, reflection, weight, packet);
}

#ifdef CLU_LIGHTS
/* By the full search: the lane's shadow ray. */
INLINED int lane_hidden(World* world, const Shading* h, u32 lane, vec d, real distance)
{
    World copy = *world;
    Ray shadow;
    shadow.o = make_vec(h->p[0][lane], h->p[1][lane], h->p[2][lane]);
    shadow.d = d;
    shadow.excess = length_excess(d);
    shadow.left = (u32)h->left[lane];
    shadow.left_inside = !h->beyond_inside[lane];
    shadow.err = h->err[lane];
    const int hidden = is_hidden_in_full(&copy, &shadow, distance);
    for (u32 i = 0; i < STAT_COUNT; i++) world->stats[i] = copy.stats[i];
    return hidden;
}

/* Adds what arrives straight from one light (as absorbed, kernels/trace.h). */
INLINED void shade_light(World* world, wide_mask lightable, const Shading* h, u32 number, const Packet* packet,
                         TileLight* light)
{
    __global const LayoutLight* source = &world->lights[number];
    const rgb color = load_rgb(source->color);
    const wide_vec p = load_vecs(h->p[0]), away = wide_less(p, source->point);
    const wide distance = wide_sqrt(wide_dot(away, away)), zero = wide_all(R(0));
    const wide_vec d = wide_scaled(away, R(-1) / distance);
    const wide cosine = wide_dot(load_vecs(h->n[0]), d);
    wide_mask lit = lightable & (distance > zero) & (cosine > zero);
#ifdef CLU_AS_GUN
    const wide_rgb absorption = load_colors(h->absorption[0]);
    lit &= ~(wide_larger(absorption.r * color.r, wide_larger(absorption.g * color.g, absorption.b * color.b)) <
             wide_all(R(world->frame->cutoff)));
#endif
    if (!any_lane(lit)) return;
    count_lanes(world, STAT_SHADOW, lit);
    PacketLine l;
    l.o = p;
    l.d = d;
    l.err = load_lanes(h->err);
    l.left = load_ids(h->left);
    l.left_inside = ~load_ids(h->beyond_inside);
    wide_mask open = lit;
    if (QUICK) lit &= ~packet_hidden(world, &l, distance, &open);
    u32 unsure = wide_bits(open);
    real d_lanes[3][LANES], distances[LANES], cosines[LANES];
    store_wide(distance, distances);
    store_wide(cosine, cosines);
    u32 bits = wide_bits(lit);
    if (unsure) {
        store_wide(d.x, d_lanes[0]);
        store_wide(d.y, d_lanes[1]);
        store_wide(d.z, d_lanes[2]);
    }
    for (; unsure; unsure &= unsure - 1u) {
        const u32 i = first_lane(unsure);
        if (lane_hidden(world, h, i, make_vec(d_lanes[0][i], d_lanes[1][i], d_lanes[2][i]), distances[i]))
            bits &= ~(1u << i);
    }
    for (; bits; bits &= bits - 1u) {
        const u32 i = first_lane(bits);
        const rgb filter = make_rgb(h->absorption[0][i], h->absorption[1][i], h->absorption[2][i]);
        const rgb arriving = rgb_filter(rgb_filter(color, filter), lane_color(packet, ROW_WEIGHT, i));
        add_light(world, light, packet->ids[ID_TAG][i],
                  rgb_scale(arriving, diffuse(world->frame->light_law, cosines[i], distances[i])));
    }
}
#endif

INLINED void shade_packet(World* world, PacketStacks* stacks, const Packet* packet, const LaneHits* hits,
                          TileLight* light)
{
    Shading h = {.cosine = {R(0)}}; /* all of it 0, for lanes that meet nothing are computed with too */
    int lanes[LANES];
    for (u32 i = 0; i < LANES; i++)
        lanes[i] = has_ray(packet, i) && shade_lane(world, &h, i, packet, hits, light) ? -1 : 0;
    const wide_mask met = load_ids(lanes);
    if (!any_lane(met)) return;
#ifdef CLU_LIGHTS
    const wide_mask lightable = met & load_ids(h.lightable);
    if (any_lane(lightable))
        for (u32 i = 0; i < world->frame->light_count; i++) shade_light(world, lightable, &h, i, packet, light);
#endif
    const wide_vec d = packet_vec(packet, ROW_D);
    wide_rgb reflection = load_colors(h.reflection[0]), weight = load_colors(packet->rows[ROW_WEIGHT]);
#ifdef CLU_EXTINCTION
    const wide_rgb e = load_colors(h.extinction[0]);
    const wide zero = wide_all(R(0));
    if (any_lane(met & ((e.r != zero) | (e.g != zero) | (e.b != zero)))) {
        const wide t = load_lanes(h.t);
        weight.r *= wide_exp(-e.r * t);
        weight.g *= wide_exp(-e.g * t);
        weight.b *= wide_exp(-e.b * t);
    }
#endif
#ifdef CLU_TRANSPARENT
    shade_refraction(world, stacks, met, &h, d, &reflection, weight, packet);
#endif
    shade_reflection(world, stacks, met, &h, d, reflection, weight, packet);
}

#endif
