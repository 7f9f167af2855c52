/* Where a packet of rays next leaves its media or enters what has precedence over them: in plain arithmetic, with a
 * bound on what rounding does; a lane in which that could tell a different story is left unsure. */
#ifndef POOL_PACKET_H
#define POOL_PACKET_H

#include "kernels/lanes.h"

/* Media as signed numbers, so that an object has precedence over a medium if its id is less. */
#define MEDIUM_VACUUM 0x7fffffff
#define MEDIUM_NO_RAY (-1) /* an empty lane: nothing has precedence over it */

#define OBJECT_NONE 0xffffffffu   /* the ray meets nothing */
#define OBJECT_UNSURE 0xfffffffeu /* the scalar search must tell */

/* Roundings that a place may be off by, of the numbers' size. Not proven: what was compared with the full search. */
#define PACKET_ROUNDINGS (24.0f * UNIT_ROUNDOFF)

typedef struct {
    vreal lo, hi, slope_lo, slope_hi;
    vint keep; /* inside is lo..hi; else inside is all but lo..hi */
} PacketSpan;

/* The rays relative to an object's centre. */
typedef struct {
    vvec origin, d, base; /* base: the line's point nearest to the centre */
    vreal middle;         /* the ray parameter there */
    vreal err;
    vword left;
    vint left_inside;
    vreal begin; /* where the rays may meet the object at the earliest */
    vint want;   /* the lanes that this object concerns */
    vreal doubt; /* the least ray parameter from which on something is in doubt, of any object so far */
} PacketLine;

/* Doubts that lie behind the ray concern it no more. */
INLINED void doubt_at(PacketLine* l, vint where, vreal t)
{
    l->doubt = fmin(l->doubt, CHOOSE(l->want & where & (t > -l->err * 64.0f), t, FAR));
}

/* Nothing is known of the object but its bound. */
INLINED void doubt_object(PacketLine* l)
{
    l->doubt = fmin(l->doubt, CHOOSE(l->want, l->begin, FAR));
}

INLINED PacketSpan packet_sphere(__global const LayoutSphere* s, PacketLine* l, u32 member)
{
    const vvec o = vless(l->base, s->c);
    const vreal b = vdot(o, l->d);
    const vvec p = valong(o, l->d, -b);
    const float r = s->r;
    const vreal discriminant = fma(-p.x, p.x, fma(-p.y, p.y, fma(-p.z, p.z, ALL(r * r)))), middle = l->middle - b;
    const vint left = (vint)(l->left == (vword)(member));
    doubt_at(l, ~left & (fabs(discriminant) < 4.0f * r * l->err), middle);
    const vreal root = sqrt(fmax(discriminant, ALL(0.0f)));
    const vint none = discriminant <= 0.0f;
    PacketSpan span;
    span.lo = CHOOSE(none, FAR, middle - root);
    span.hi = CHOOSE(none, -FAR, middle + root);
    span.slope_lo = span.slope_hi = r / root;
    span.keep = (vint)(-1);
    if (any_lane(left)) {
        span.lo = CHOOSE(left, -FAR, span.lo);
        span.hi = CHOOSE(left, CHOOSE(l->left_inside, 2.0f * middle, -FAR), span.hi);
        span.slope_hi = CHOOSE(left, r / fabs(middle), span.slope_hi);
    }
    return span;
}

/* The most that a quadric's value changes by, a unit of length, within reach of the object's centre; halved. */
INLINED float quadric_steepness(__global const LayoutQuadric* q, float reach)
{
    const float far = reach + fabs(q->c[0]) + fabs(q->c[1]) + fabs(q->c[2]);
    return fma(q->norm * q->norm, far, q->norm * fabs(q->g));
}

INLINED vreal quadric_value_at(__global const LayoutQuadric* q, vvec x)
{
    const vreal z = fma(fma(ALL(q->s[2]), x.z, ALL(-2.0f * q->g)), x.z, ALL(q->w));
    return fma(q->s[0] * x.x, x.x, fma(q->s[1] * x.y, x.y, z));
}

INLINED PacketSpan packet_quadric(__global const LayoutQuadric* q, PacketLine* l, u32 member, float reach)
{
    const vvec x = vapply(q->m, vless(l->base, q->c)), d = vapply(q->m, l->d);
    const float s0 = q->s[0], s1 = q->s[1], s2 = q->s[2];
    const vreal a = fma(s0 * d.x, d.x, fma(s1 * d.y, d.y, s2 * d.z * d.z)), dd = vdot(d, d);
    const vreal b = fma(s0 * d.x, x.x, fma(s1 * d.y, x.y, fma(s2 * d.z, x.z, -q->g * d.z)));
    const vreal c = quadric_value_at(q, x), ac = a * c, discriminant = fma(b, b, -ac);
    const float steepness = quadric_steepness(q, reach);
    const vint left = (vint)(l->left == (vword)(member)), flat = fabs(a) < 1e-3f * dd;
    const vreal over = 1.0f / a, middle = fma(-b, over, l->middle);
    const vreal rounded = fma(4.0f * steepness * l->err, sqrt(dd), 8.0f * UNIT_ROUNDOFF * fma(b, b, fabs(ac)));
    doubt_at(l, flat | (~left & (fabs(discriminant) < rounded)), CHOOSE(flat, ALL(0.0f), middle));
    const vreal root = sqrt(fmax(discriminant, ALL(0.0f)));
    const vreal s = -(b + copysign(root, b)), t0 = c / s, t1 = s * over;
    const vint none = discriminant <= 0.0f;
    PacketSpan span;
    span.lo = CHOOSE(none, FAR, l->middle + fmin(t0, t1));
    span.hi = CHOOSE(none, -FAR, l->middle + fmax(t0, t1));
    span.slope_lo = span.slope_hi = steepness / root;
    span.keep = a > 0.0f;
    if (any_lane(left)) {
        /* The ray goes between the ends, and meets the second one; or it meets the quadric no more. */
        const vint within = ~(span.keep ^ l->left_inside);
        span.lo = CHOOSE(left, -FAR, span.lo);
        span.hi = CHOOSE(left, CHOOSE(within, 2.0f * middle, -FAR), span.hi);
        span.slope_hi = CHOOSE(left, steepness / fabs(fma(-a, l->middle, b)), span.slope_hi);
    }
    return span;
}

INLINED PacketSpan packet_member(const World* world, u32 member, PacketLine* l, float reach)
{
    const u32 index = member >> MEMBER_SHIFT;
    if ((member & MEMBER_KIND) == MEMBER_SPHERE) return packet_sphere(&world->spheres[index], l, member);
    return packet_quadric(&world->quadrics[index], l, member, reach);
}

/* What an object holds of the lines: one interval less some. */
#define PACKET_GAPS (CLU_GROUP_CAPACITY < 8 ? CLU_GROUP_CAPACITY : 8)
typedef struct {
    vreal lo, hi, slope_lo, slope_hi;
    vword face_lo, face_hi;
    u32 gap_count;
    vreal gap_lo[PACKET_GAPS], gap_hi[PACKET_GAPS], gap_slope_lo[PACKET_GAPS], gap_slope_hi[PACKET_GAPS];
    u32 gap_face[PACKET_GAPS];
} PacketSolid;

/* Where `in`, what the solid and the span hold. */
INLINED void packet_cut(PacketSolid* s, vint in, const PacketSpan* span, u32 face)
{
    const vint later = in & (span->lo > s->lo), sooner = in & (span->hi < s->hi);
    s->lo = CHOOSE(later, span->lo, s->lo);
    s->slope_lo = CHOOSE(later, span->slope_lo, s->slope_lo);
    s->face_lo = CHOOSE(later, (vword)(face), s->face_lo);
    s->hi = CHOOSE(sooner, span->hi, s->hi);
    s->slope_hi = CHOOSE(sooner, span->slope_hi, s->slope_hi);
    s->face_hi = CHOOSE(sooner, (vword)(face), s->face_hi);
}

/* Where `in`, takes the span out of the solid. */
INLINED void packet_gap(PacketSolid* s, PacketLine* l, vint in, const PacketSpan* span, u32 face)
{
    if (s->gap_count == PACKET_GAPS) {
        doubt_object(l);
        return;
    }
    s->gap_lo[s->gap_count] = CHOOSE(in, span->lo, FAR);
    s->gap_hi[s->gap_count] = CHOOSE(in, span->hi, -FAR);
    s->gap_slope_lo[s->gap_count] = span->slope_lo;
    s->gap_slope_hi[s->gap_count] = span->slope_hi;
    s->gap_face[s->gap_count++] = face;
}

INLINED void packet_plane(PacketSolid* s, const PacketLine* l, __global const LayoutPlane* plane, u32 member)
{
    const float nx = plane->n[0], ny = plane->n[1], nz = plane->n[2];
    const vreal nd = fma(nx, l->d.x, fma(ny, l->d.y, nz * l->d.z));
    vreal height = fma(nx, l->origin.x, fma(ny, l->origin.y, fma(ALL(nz), l->origin.z, ALL(-plane->h))));
    height = CHOOSE((vint)(l->left == (vword)(member)), CHOOSE(l->left_inside, -FAR, FAR), height);
    const vreal slope = 1.0f / nd, t = -height * slope;
    const vint enters = AS_INTS(nd) >> 31, later = enters & (t > s->lo), sooner = ~enters & (t < s->hi);
    s->lo = CHOOSE(later, t, s->lo);
    s->slope_lo = CHOOSE(later, slope, s->slope_lo);
    s->face_lo = CHOOSE(later, (vword)(member), s->face_lo);
    s->hi = CHOOSE(sooner, t, s->hi);
    s->slope_hi = CHOOSE(sooner, slope, s->slope_hi);
    s->face_hi = CHOOSE(sooner, (vword)(member), s->face_hi);
}

INLINED void packet_group(const World* world, const LayoutGroup group, PacketLine* l, float reach, PacketSolid* s)
{
    for (u32 i = 0; i < group.count; i++) {
        const u32 member = world->members[group.begin + i];
        if ((member & MEMBER_KIND) == MEMBER_PLANE) {
            packet_plane(s, l, &world->planes[member >> MEMBER_SHIFT], member);
            continue;
        }
        const PacketSpan span = packet_member(world, member, l, reach);
        packet_cut(s, span.keep, &span, member);
        if (any_lane(~span.keep)) packet_gap(s, l, ~span.keep, &span, member);
    }
}

/* A group inside out: known of a single curved member only. */
INLINED void packet_inverse_group(const World* world, const LayoutGroup group, PacketLine* l, float reach,
                                  PacketSolid* s)
{
    const u32 member = world->members[group.begin];
    if (group.count > 1 || (member & MEMBER_KIND) == MEMBER_PLANE) {
        doubt_object(l);
        return;
    }
    const PacketSpan span = packet_member(world, member, l, reach);
    packet_gap(s, l, span.keep, &span, member | MEMBER_INVERSE);
    if (any_lane(~span.keep)) packet_cut(s, ~span.keep, &span, member | MEMBER_INVERSE);
}

INLINED PacketSolid packet_solid(const World* world, __global const LayoutObject* object, PacketLine* l, float reach)
{
    PacketSolid s;
    s.lo = -FAR;
    s.hi = FAR;
    s.slope_lo = s.slope_hi = ALL(0.0f);
    s.face_lo = s.face_hi = (vword)(MEMBER_NONE);
    s.gap_count = 0;
    for (u32 i = 0; i < object->group_count; i++) {
        const LayoutGroup group = world->groups[object->group_begin + i];
        if (group.inverse)
            packet_inverse_group(world, group, l, reach, &s);
        else
            packet_group(world, group, l, reach, &s);
    }
    return s;
}

/* A crossing of one object. */
typedef struct {
    vreal t, slope;
    vword face;
    vint hit, unsure;
} PacketEnd;

/* Where rays from outside enter the solid. */
INLINED PacketEnd packet_entry(const PacketSolid* s, vreal err)
{
    PacketEnd c;
    const vreal e_lo = fma(fabs(s->slope_lo), err, err), e_hi = fma(fabs(s->slope_hi), err, err);
    const vint begun = s->lo < 0.0f;
    c.t = CHOOSE(begun, ALL(0.0f), s->lo);
    c.slope = s->slope_lo;
    c.face = s->face_lo;
    c.unsure = (fabs(s->lo) < e_lo) & (s->hi > -e_hi);
    vreal e = CHOOSE(begun, ALL(0.0f), e_lo);
    /* A gap ends in another at most as often as there are gaps. */
    for (u32 round = 0; round < s->gap_count; round++) {
        for (u32 i = 0; i < s->gap_count; i++) {
            const vreal gap_e_lo = fma(s->gap_slope_lo[i], err, err), gap_e_hi = fma(s->gap_slope_hi[i], err, err);
            const vint some = s->gap_lo[i] < s->gap_hi[i], other = (vint)(c.face != (vword)(s->gap_face[i]));
            c.unsure |= some & ((fabs(c.t - s->gap_lo[i]) < e + gap_e_lo) |
                                ((fabs(c.t - s->gap_hi[i]) < e + gap_e_hi) & other));
            const vint in = (s->gap_lo[i] <= c.t) & (c.t < s->gap_hi[i]);
            c.t = CHOOSE(in, s->gap_hi[i], c.t);
            e = CHOOSE(in, gap_e_hi, e);
            c.slope = CHOOSE(in, s->gap_slope_hi[i], c.slope);
            c.face = CHOOSE(in, (vword)(s->gap_face[i]), c.face);
        }
    }
    c.hit = c.t < s->hi;
    c.unsure |= (fabs(c.t - s->hi) < e + e_hi) | (c.hit & (c.t <= e));
    c.unsure &= s->hi > -e_hi;
    return c;
}

/* Where rays from inside leave the solid. */
INLINED PacketEnd packet_exit(const PacketSolid* s, vreal err)
{
    PacketEnd c;
    const vreal e_lo = fma(fabs(s->slope_lo), err, err), e_hi = fma(fabs(s->slope_hi), err, err);
    c.t = s->hi;
    c.slope = s->slope_hi;
    c.face = s->face_hi;
    c.hit = (vint)(-1);
    c.unsure = (s->hi < e_hi) | (s->lo > -e_lo);
    vreal e = e_hi;
    for (u32 i = 0; i < s->gap_count; i++) {
        const vreal gap_e_lo = fma(s->gap_slope_lo[i], err, err), gap_e_hi = fma(s->gap_slope_hi[i], err, err);
        const vint ahead = (s->gap_lo[i] < s->gap_hi[i]) & (s->gap_hi[i] > -gap_e_hi);
        c.unsure |= ahead & (s->gap_lo[i] < gap_e_lo);
        const vint sooner = ahead & (s->gap_lo[i] < c.t);
        c.t = CHOOSE(sooner, s->gap_lo[i], c.t);
        c.slope = CHOOSE(sooner, s->gap_slope_lo[i], c.slope);
        e = CHOOSE(sooner, gap_e_lo, e);
        c.face = CHOOSE(sooner, (vword)(s->gap_face[i]), c.face);
    }
    c.unsure |= ~(c.t < INFINITY) | (c.t < e);
    return c;
}

/* Each where its rays are; what a packet has no lane for is not worked out. */
INLINED PacketEnd packet_end(const PacketSolid* s, const PacketLine* l, vint inside)
{
    PacketEnd c = {FAR, ALL(0.0f), (vword)(MEMBER_NONE), (vint)(0), (vint)(0)};
    if (any_lane(l->want & ~inside)) {
        c = packet_entry(s, l->err);
        c.hit &= ~inside;
        c.unsure &= ~inside;
    }
    if (any_lane(l->want & inside)) {
        const PacketEnd x = packet_exit(s, l->err);
        c.t = CHOOSE(inside, x.t, c.t);
        c.slope = CHOOSE(inside, x.slope, c.slope);
        c.face = CHOOSE(inside, x.face, c.face);
        c.hit |= inside;
        c.unsure = CHOOSE(inside, x.unsure, c.unsure);
    }
    return c;
}

/* What the packet's rays meet. */
typedef struct {
    vreal t, slope;
    vword object; /* or OBJECT_* */
    vword face, after;
} PacketHit;

/* What the object's members are off as lengths: how far from its centre their numbers reach. */
INLINED float object_reach(__global const LayoutObject* object)
{
    return object->radius < INFINITY ? object->radius : object->grain;
}

/* One more object: the nearest crossing stays in *best. */
INLINED void packet_try(World* world, u32 id, vvec o, vint medium, PacketLine* l, PacketHit* best)
{
    __global const LayoutObject* object = &world->objects[id];
    const float radius = object->radius, reach = object_reach(object);
    l->origin = vless(o, object->center);
    l->middle = -vdot(l->origin, l->d);
    l->base = valong(l->origin, l->d, l->middle);
    l->begin = fmax(l->middle - radius, ALL(0.0f));
    l->want = (vdot(l->base, l->base) <= radius * radius * 1.00001f) & (l->middle + radius > 0.0f) &
              (l->begin < best->t) & (medium >= (vint)((int)id));
    if (!any_lane(l->want)) return;
    COUNT(world, STAT_TESTS);
    if (object->form != FORM_ALL) {
        doubt_object(l);
        return;
    }
    l->err = PACKET_ROUNDINGS * (fabs(l->middle) + reach);
    const PacketSolid solid = packet_solid(world, object, l, reach);
    const PacketEnd c = packet_end(&solid, l, medium == (vint)((int)id));
    const vreal doubtful = fmin(l->doubt, fmax(fmin(c.t, solid.hi), ALL(0.0f)));
    l->doubt = CHOOSE(l->want & c.unsure, doubtful, l->doubt);
    const vint nearer = l->want & c.hit & (c.t < best->t);
    best->t = CHOOSE(nearer, c.t, best->t);
    best->slope = CHOOSE(nearer, c.slope, best->slope);
    best->face = CHOOSE(nearer, c.face, best->face);
    best->object = CHOOSE(nearer, (vword)(id), best->object);
}

/* About how far the member's surface is from p (relative to the object's centre): never less; negative inside. */
INLINED vreal packet_distance(const World* world, u32 member, vvec p, float reach)
{
    const u32 index = member >> MEMBER_SHIFT;
    if ((member & MEMBER_KIND) == MEMBER_PLANE) {
        __global const LayoutPlane* plane = &world->planes[index];
        return fma(plane->n[0], p.x, fma(plane->n[1], p.y, fma(ALL(plane->n[2]), p.z, ALL(-plane->h))));
    }
    if ((member & MEMBER_KIND) == MEMBER_SPHERE) {
        __global const LayoutSphere* s = &world->spheres[index];
        const vvec x = vless(p, s->c);
        return fma(x.x, x.x, fma(x.y, x.y, fma(x.z, x.z, ALL(-s->r * s->r)))) * (0.5f / (reach + s->r));
    }
    __global const LayoutQuadric* q = &world->quadrics[index];
    return quadric_value_at(q, vapply(q->m, vless(p, q->c))) * (0.5f / quadric_steepness(q, reach));
}

/* Whether the object holds the points p (relative to its centre), and the least distance of its surfaces but `own`. */
INLINED vint packet_holds(const World* world, __global const LayoutObject* object, vvec p, vword own, vreal* least)
{
    const float reach = object_reach(object);
    vint within = (vint)(-1);
    *least = FAR;
    for (u32 i = 0; i < object->group_count; i++) {
        const LayoutGroup group = world->groups[object->group_begin + i];
        vreal most = -FAR;
        for (u32 k = 0; k < group.count; k++) {
            const u32 member = world->members[group.begin + k];
            const vreal distance = packet_distance(world, member, p, reach);
            *least = CHOOSE((vint)(own == (vword)(member)), *least, fmin(*least, fabs(distance)));
            most = fmax(most, distance);
        }
        within &= group.inverse ? most > 0.0f : most < 0.0f;
    }
    return within;
}

/* At the points where the rays meet something: where another surface lies within tolerance, the lane is not sure;
 * where a medium is left, what lies beyond goes to best->after. Returns the lanes that are sure. */
INLINED vint packet_look_around(World* world, vvec o, vvec d, vint medium, vint sure, vreal tolerance, u32 last,
                                PacketHit* best)
{
    const vint found = best->t < INFINITY;
    const vvec p = valong(o, d, CHOOSE(found, best->t, ALL(0.0f)));
    const vword own = best->face & ~MEMBER_INVERSE;
    vint seeking = found & (vint)(best->object == AS_WORDS(medium));
    best->after = CHOOSE(seeking, (vword)(VACUUM), best->object);
    if (any_lane(seeking)) last = world->frame->object_count;
    for (u32 id = 0; id < last; id++) {
        __global const LayoutObject* object = &world->objects[id];
        const vvec at = vless(p, object->center);
        const vint concerned = (medium >= (vint)((int)id)) | seeking;
        const vint near = found & sure & concerned & (vdot(at, at) <= object->radius * object->radius * 1.0001f);
        if (!any_lane(near)) continue;
        if (object->form != FORM_ALL) {
            sure &= ~near;
            continue;
        }
        vreal least;
        const vint within = near & packet_holds(world, object, at, own, &least);
        sure &= ~(near & (least < tolerance));
        const vint here = seeking & within & ((vint)((int)id) > medium);
        best->after = CHOOSE(here, (vword)(id), best->after);
        seeking &= ~here;
    }
    return sure;
}

/* How many objects, from the first, some lane's ray may meet: what is below its medium is not there for it. */
INLINED u32 packet_last(const World* world, vint medium)
{
    int lanes[POOL_WIDTH], lowest = MEDIUM_NO_RAY;
    STORE(medium, 0, lanes);
    for (u32 i = 0; i < POOL_WIDTH; i++) lowest = max(lowest, lanes[i]);
    return min((u32)lowest + 1u, world->frame->object_count);
}

INLINED PacketHit packet_search(World* world, vvec o, vvec d, vword left, vint left_inside, vint medium)
{
    PacketLine l;
    l.d = d;
    l.left = left;
    l.left_inside = left_inside;
    l.doubt = FAR;
    PacketHit best = {FAR, ALL(0.0f), (vword)(OBJECT_NONE), (vword)(MEMBER_NONE), (vword)(VACUUM)};
    const u32 last = packet_last(world, medium);
    for (u32 id = 0; id < last; id++) packet_try(world, id, o, medium, &l, &best);
    const vint found = best.t < INFINITY;
    const vreal size = fmax(fabs(best.t), fmax(fabs(o.x), fmax(fabs(o.y), fabs(o.z))));
    const vreal tolerance = PACKET_ROUNDINGS * fmax(size, ALL(1.0f)) * (fabs(best.slope) + 3.0f);
    vint sure = ~(l.doubt < best.t + tolerance * 4.0f);
    /* gun's law of refraction sends rays out of their medium: they find its boundary behind them */
    sure &= ~found | ((tolerance < 1e-2f) & (best.t > 0.0f));
    if (any_lane(found & sure)) sure = packet_look_around(world, o, d, medium, sure, tolerance, last, &best);
    best.object = CHOOSE(sure, best.object, (vword)(OBJECT_UNSURE));
    return best;
}

#endif
