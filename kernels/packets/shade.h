/* What becomes of a packet's rays: what optics makes of the surfaces that they meet, all lanes together (as
 * trace_segment has it for one ray, kernels/trace.h). */
#ifndef CLUCIDA_PACKETS_SHADE_H
#define CLUCIDA_PACKETS_SHADE_H

#include "kernels/hidden.h"
#include "kernels/packets/stacks.h"
#include "kernels/packets/surface.h"
#include "kernels/trace.h"

/* The surfaces as their rays meet them. */
typedef struct {
    wide_vec d, p, n, facing; /* n: outward; facing: on the ray's side */
    wide cosine, t, err;
    wide_id left, before, after; /* the primitive; media as MEDIUM_* has them */
    wide_mask beyond_inside;
} Incidence;

/* The surfaces' optics, lane by lane. Truths are -1 or 0. */
typedef struct {
    real w[LANES]; /* the ratio of the indices */
    real reflection[3][LANES], refraction[3][LANES];
    int fresnel[LANES], transparent[LANES];    /* transparent: there is refraction, or total reflection */
    int before_open[LANES], after_open[LANES]; /* the medium is not opaque */
#ifdef CLU_EXTINCTION
    real extinction[3][LANES];
#endif
#ifdef CLU_LIGHTS
    real absorption[3][LANES];
    int lightable[LANES]; /* the lights may reach the surface */
#endif
} Shading;

/* Three rows of lanes, one after the other. */
INLINED wide_vec load_vecs(const real* rows)
{
    return make_wide_vec(load_lanes(rows), load_lanes(rows + LANES), load_lanes(rows + 2 * LANES));
}

INLINED Incidence packet_incidence(const Packet* packet, const PacketSurfaces* s)
{
    Incidence c;
    const wide zero = wide_all(R(0)), one = wide_all(R(1));
    const wide_id object = load_ids(s->object), face = load_ids(s->face);
    c.d = packet_vec(packet, ROW_D);
    c.p = load_vecs(s->p[0]);
    c.n = load_vecs(s->n[0]);
    c.t = load_lanes(s->t);
    c.err = load_lanes(s->err);
    c.before = load_ids(packet->ids[ID_MEDIUM]);
    c.after = load_ids(s->after);
    const wide_mask entering = c.after == object;
    const wide side = where(entering, one, -one);
    c.facing = wide_scaled(c.n, side);
    c.cosine = wide_smaller(wide_larger(-wide_dot(c.d, c.facing), zero), one);
    c.left = face & all_ids(~(int)MEMBER_INVERSE);
    c.beyond_inside = entering ^ ((face & all_ids((int)MEMBER_INVERSE)) != all_ids(0));
    return c;
}

INLINED int is_open(const World* world, u32 medium)
{
    return medium == VACUUM || index_of(world, medium) != R(0) ? -1 : 0;
}

/* A lane's surface, as far as its optics depend on it. */
INLINED Surface lane_surface(const PacketSurfaces* surfaces, u32 lane)
{
    Surface s;
    s.object = (u32)surfaces->object[lane];
    s.before = unsigned_medium(surfaces->before[lane]);
    s.after = unsigned_medium(surfaces->after[lane]);
    s.entering = s.after == s.object;
    s.t = surfaces->t[lane];
    s.p = make_vec(surfaces->p[0][lane], surfaces->p[1][lane], surfaces->p[2][lane]);
    s.n = make_vec(surfaces->n[0][lane], surfaces->n[1][lane], surfaces->n[2][lane]);
    return s;
}

/* medium: that of the rays, which need not be the surface's `before`: a ray may have been silently crossed out of it.
 */
INLINED void keep_finish(const World* world, Shading* h, u32 lanes, const Surface* s, u32 medium, const Finish* finish)
{
    const int transparent = finish->index > R(0) ? -1 : 0, fresnel = finish->flags & OPTICS_FRESNEL ? -1 : 0;
    const real w = transparent ? index_of(world, s->before) / index_of(world, s->after) : R(0);
    const int before_open = is_open(world, medium), after_open = is_open(world, s->after);
    rgb reflection = finish->reflection;
#ifdef CLU_AS_GUN
    if (transparent && !s->entering) reflection = rgb_scale(reflection, R(0.9f));
#endif
#ifdef CLU_EXTINCTION
    rgb e = grey(R(0));
    if (medium != VACUUM) e = load_rgb(world->optics[world->objects[medium].optics].extinction);
#endif
#ifdef CLU_LIGHTS
    const int lightable = medium == VACUUM && rgb_largest(finish->absorption) > R(0) ? -1 : 0;
#endif
    for (; lanes; lanes &= lanes - 1u) {
        const u32 lane = first_lane(lanes);
        h->w[lane] = w;
        h->transparent[lane] = transparent;
        h->fresnel[lane] = fresnel;
        h->before_open[lane] = before_open;
        h->after_open[lane] = after_open;
        put_lane(h->reflection, lane, reflection.r, reflection.g, reflection.b);
        put_lane(h->refraction, lane, finish->refraction.r, finish->refraction.g, finish->refraction.b);
#ifdef CLU_EXTINCTION
        put_lane(h->extinction, lane, e.r, e.g, e.b);
#endif
#ifdef CLU_LIGHTS
        h->lightable[lane] = lightable;
        put_lane(h->absorption, lane, finish->absorption.r, finish->absorption.g, finish->absorption.b);
#endif
    }
}

#ifdef CLU_EMISSION
INLINED void shade_emission(World* world, const Packet* packet, u32 lane, u32 medium, real t, const Finish* finish,
                            TileLight* light)
{
    const rgb arriving = rgb_filter(lane_color(packet, ROW_WEIGHT, lane), transmittance(world, medium, t));
    add_light(world, light, packet->ids[ID_TAG][lane], rgb_filter(arriving, finish->refraction));
}
#endif

/* The optics of lanes that meet surfaces of the same object between the same media. Returns the lanes whose rays go on.
 */
INLINED u32 shade_lanes(World* world, Shading* h, u32 lanes, const Packet* packet, const PacketSurfaces* surfaces,
                        TileLight* light)
{
    Surface s = lane_surface(surfaces, first_lane(lanes));
    const u32 shown = shown_object(world, &s), medium = unsigned_medium(packet->ids[ID_MEDIUM][first_lane(lanes)]);
    u32 alike = lanes, going = lanes;
#ifdef CLU_TEXTURE
    if (world->objects[shown].texture != TEXTURE_NONE) alike = 0;
#endif
    for (u32 rest = lanes; rest;) {
        const u32 lane = first_lane(rest), these = alike ? alike : 1u << lane;
        if (!alike) s = lane_surface(surfaces, lane);
        rest &= ~these;
        const Finish finish = finish_at(world, shown, &s);
#ifdef CLU_EMISSION
        if (finish.index < R(0)) {
            going &= ~these;
            for (u32 some = these; some; some &= some - 1u) {
                const u32 i = first_lane(some);
                shade_emission(world, packet, i, medium, surfaces->t[i], &finish, light);
            }
            continue;
        }
#endif
        keep_finish(world, h, these, &s, medium, &finish);
    }
    return going;
}

/* The rays that meet nothing see the sky. */
INLINED void shade_sky(World* world, u32 lanes, const Packet* packet, TileLight* light)
{
    for (; lanes; lanes &= lanes - 1u) {
        const u32 lane = first_lane(lanes);
        const vec d = make_vec(packet->rows[ROW_D][lane], packet->rows[ROW_D + 1][lane], packet->rows[ROW_D + 2][lane]);
        const rgb sky = sky_through(world, unsigned_medium(packet->ids[ID_MEDIUM][lane]), d);
        add_light(world, light, packet->ids[ID_TAG][lane], rgb_filter(lane_color(packet, ROW_WEIGHT, lane), sky));
    }
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
INLINED void push_rays(World* world, PacketStacks* stacks, wide_mask which, const Incidence* c, u32 refracted,
                       wide_vec d, wide_rgb filter, wide_rgb weight, const Packet* from)
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
    put_vec(&rays, ROW_O, c->p);
    put_vec(&rays, ROW_D, d);
    store_wide(wide_length_excess(d), rays.rows[ROW_EXCESS]);
    store_wide(c->err, rays.rows[ROW_ERR]);
    store_ids(c->left, rays.ids[ID_LEFT]);
    store_ids(refracted ? c->beyond_inside : ~c->beyond_inside, rays.ids[ID_LEFT_INSIDE]);
    store_ids(refracted ? c->after : c->before, rays.ids[ID_MEDIUM]);
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
INLINED void shade_refraction(World* world, PacketStacks* stacks, wide_mask met, const Shading* h, const Incidence* c,
                              wide_rgb* reflection, wide_rgb weight, const Packet* packet)
{
    const wide one = wide_all(R(1)), zero = wide_all(R(0));
    const wide_mask transparent = met & load_ids(h->transparent);
    if (!any_lane(transparent)) return;
    const wide w = load_lanes(h->w), det = wide_refraction_det(w, c->cosine);
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
    const wide reflectance = wide_reflectance(w, c->cosine, root);
    filter = wide_rgb_scaled(filter, where(weighed, one - reflectance, one));
    *reflection = wide_rgb_scaled(*reflection, where(weighed, reflectance, one));
#endif
    const wide_vec out = wide_refracted(c->d, c->facing, w, c->cosine, root);
    push_rays(world, stacks, passes & load_ids(h->after_open), c, 1, out, filter, weight, packet);
}
#endif

INLINED void shade_reflection(World* world, PacketStacks* stacks, wide_mask met, const Shading* h, const Incidence* c,
                              wide_rgb reflection, wide_rgb weight, const Packet* packet)
{
    const wide_mask open = met & load_ids(h->before_open);
    if (!any_lane(open)) return;
    const wide twice = R(2) * c->cosine;
    const wide_vec out =
        wide_renormalized(wide_along(c->d, c->facing, wide_fma(-twice, wide_length_excess(c->facing), twice)));
    push_rays(world, stacks, open, c, 0, out, reflection, weight, packet);
}

#ifdef CLU_LIGHTS
/* By the full search: the lane's shadow ray. */
INLINED int lane_hidden(World* world, const PacketSurfaces* surfaces, u32 lane, vec d, real distance)
{
    World copy = *world;
    Ray shadow;
    const u32 face = (u32)surfaces->face[lane];
    const int entering = surfaces->after[lane] == surfaces->object[lane];
    shadow.o = make_vec(surfaces->p[0][lane], surfaces->p[1][lane], surfaces->p[2][lane]);
    shadow.d = d;
    shadow.excess = length_excess(d);
    shadow.left = face & ~MEMBER_INVERSE;
    shadow.left_inside = entering == ((face & MEMBER_INVERSE) != 0u);
    shadow.err = surfaces->err[lane];
    const int hidden = is_hidden_in_full(&copy, &shadow, distance);
    for (u32 i = 0; i < STAT_COUNT; i++) world->stats[i] = copy.stats[i];
    return hidden;
}

/* Adds what arrives straight from one light (as absorbed, kernels/trace.h). */
INLINED void shade_light(World* world, wide_mask lightable, const Shading* h, const PacketSurfaces* surfaces,
                         const Incidence* c, u32 number, const Packet* packet, TileLight* light)
{
    __global const LayoutLight* source = &world->lights[number];
    const rgb color = load_rgb(source->color);
    const wide_vec away = wide_less(c->p, source->point);
    const wide distance = wide_sqrt(wide_dot(away, away)), zero = wide_all(R(0));
    const wide_vec d = wide_scaled(away, R(-1) / distance);
    const wide cosine = wide_dot(c->n, d);
    wide_mask lit = lightable & (distance > zero) & (cosine > zero);
#ifdef CLU_AS_GUN
    const wide_rgb absorption = load_colors(h->absorption[0]);
    lit &= ~(wide_larger(absorption.r * color.r, wide_larger(absorption.g * color.g, absorption.b * color.b)) <
             wide_all(R(world->frame->cutoff)));
#endif
    if (!any_lane(lit)) return;
    count_lanes(world, STAT_SHADOW, lit);
    PacketLine l;
    l.o = c->p;
    l.d = d;
    l.err = c->err;
    l.left = c->left;
    l.left_inside = ~c->beyond_inside;
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
        if (lane_hidden(world, surfaces, i, make_vec(d_lanes[0][i], d_lanes[1][i], d_lanes[2][i]), distances[i]))
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

INLINED void shade_packet(World* world, PacketStacks* stacks, const Packet* packet, const PacketSurfaces* surfaces,
                          TileLight* light)
{
    const wide_id medium = load_ids(packet->ids[ID_MEDIUM]), object = load_ids(surfaces->object);
    const wide_id before = load_ids(surfaces->before), after = load_ids(surfaces->after);
    shade_sky(world, wide_bits(medium != all_ids(MEDIUM_NO_RAY)) & ~surfaces->met, packet, light);
    if (!surfaces->met) return;
    Shading h = {.w = {R(0)}}; /* all of it 0, for lanes that meet nothing are computed with too */
    u32 going = 0;
    for (u32 todo = surfaces->met; todo;) {
        const u32 k = first_lane(todo);
        const wide_mask alike = (object == all_ids(surfaces->object[k])) & (before == all_ids(surfaces->before[k])) &
                                (after == all_ids(surfaces->after[k])) & (medium == all_ids(packet->ids[ID_MEDIUM][k]));
        const u32 lanes = todo & wide_bits(alike);
        todo &= ~lanes;
        going |= shade_lanes(world, &h, lanes, packet, surfaces, light);
    }
    if (!going) return;
    const wide_mask met = rays_mask(going);
    const Incidence c = packet_incidence(packet, surfaces);
#ifdef CLU_LIGHTS
    const wide_mask lightable = met & load_ids(h.lightable);
    if (any_lane(lightable))
        for (u32 i = 0; i < world->frame->light_count; i++)
            shade_light(world, lightable, &h, surfaces, &c, i, packet, light);
#endif
    wide_rgb reflection = load_colors(h.reflection[0]), weight = load_colors(packet->rows[ROW_WEIGHT]);
#ifdef CLU_EXTINCTION
    const wide_rgb e = load_colors(h.extinction[0]);
    const wide zero = wide_all(R(0));
    if (any_lane(met & ((e.r != zero) | (e.g != zero) | (e.b != zero)))) {
        weight.r *= wide_decay(e.r * c.t);
        weight.g *= wide_decay(e.g * c.t);
        weight.b *= wide_decay(e.b * c.t);
    }
#endif
#ifdef CLU_TRANSPARENT
    shade_refraction(world, stacks, met, &h, &c, &reflection, weight, packet);
#endif
    shade_reflection(world, stacks, met, &h, &c, reflection, weight, packet);
}

#endif
