/* An object's next boundary along a ray: groups of members give spans, a boolean program combines them. */
#ifndef CLUCIDA_CSG_H
#define CLUCIDA_CSG_H

#include "kernels/solids/plane.h"
#include "kernels/solids/quadric.h"
#include "kernels/solids/sphere.h"
#include "kernels/solids/torus.h"

static inline Span member_span(const World* world, u32 member, const Line* line)
{
    const int left = just_left(line, member);
    const u32 index = member >> MEMBER_SHIFT;
    Span span = span_nothing();
    switch (member & MEMBER_KIND) {
#ifdef CLU_PLANE
    case MEMBER_PLANE: span = plane_span(&world->planes[index], line, left); break;
#endif
#ifdef CLU_SPHERE
    case MEMBER_SPHERE: span = sphere_span(&world->spheres[index], line, left); break;
#endif
#ifdef CLU_QUADRIC
    case MEMBER_QUADRIC: span = quadric_span(&world->quadrics[index], line, left); break;
#endif
#ifdef CLU_TORUS
    case MEMBER_TORUS: {
        const u32 part = index & 1u;
        member &= ~MEMBER_PART; /* both parts have the torus's face */
        span = torus_span(&world->tori[index >> 1], line, part, just_left(line, member));
        break;
    }
#endif
    default: break;
    }
    if (member & MEMBER_INVERSE) span.keep = !span.keep;
    span.face_lo = span.face_hi = member;
    return span;
}

/* The outward normal of the object at p (relative to its centre), which moves onto the surface. */
static inline vec member_normal(const World* world, u32 member, vec* p)
{
    const u32 index = member >> MEMBER_SHIFT;
    vec n = make_vec(R(0), R(0), R(1));
    switch (member & MEMBER_KIND) {
#ifdef CLU_PLANE
    case MEMBER_PLANE: n = plane_normal(&world->planes[index], p); break;
#endif
#ifdef CLU_SPHERE
    case MEMBER_SPHERE: n = sphere_normal(&world->spheres[index], p); break;
#endif
#ifdef CLU_QUADRIC
    case MEMBER_QUADRIC: n = quadric_normal(&world->quadrics[index], p); break;
#endif
#ifdef CLU_TORUS
    case MEMBER_TORUS: n = torus_normal(&world->tori[index >> 1], p); break;
#endif
    default: break;
    }
    return member & MEMBER_INVERSE ? scaled(n, R(-1)) : n;
}

/* All but nothing is everything; a span that starts or ends nowhere keeps one side. */
static inline Span span_simplified(Span s)
{
    if (s.keep) return s;
    if (!(s.lo < s.hi)) return span_everything();
    if (s.lo == -INFINITE && s.hi == INFINITE) return span_nothing();
    if (s.lo == -INFINITE) {
        s.lo = s.hi;
        s.slope_lo = s.slope_hi;
        s.chord = INFINITE;
        s.face_lo = s.face_hi;
        s.hi = INFINITE;
        s.keep = 1;
    } else if (s.hi == INFINITE) {
        s.hi = s.lo;
        s.slope_hi = s.slope_lo;
        s.face_hi = s.face_lo;
        s.lo = -INFINITE;
        s.keep = 1;
    }
    return s;
}

#ifdef CLU_PLANE
/* The slope of the plane that a block's lane holds, whose reference goes to *face. */
static inline real block_slope(const World* world, __global const LayoutPlaneBlock* block, wide_mask lanes,
                               const Line* line, u32* face)
{
    const u32 plane = block->plane[first_lane(wide_bits(lanes))];
    *face = MEMBER_PLANE | plane << MEMBER_SHIFT;
    return plane_slope(&world->planes[plane], line, just_left(line, *face));
}

/* Cuts the span down to what lies behind a block's planes. */
static inline void cut_block(const World* world, __global const LayoutPlaneBlock* block, const Line* line, Span* span)
{
    wide ends_lo, ends_hi;
    plane_block_ends(block, line, &ends_lo, &ends_hi);
    const real lo = wide_largest(ends_lo), hi = wide_smallest(ends_hi);
    if (lo > span->lo) {
        span->lo = lo;
        span->chord = INFINITE;
        span->slope_lo = block_slope(world, block, ends_lo == wide_all(lo), line, &span->face_lo);
    }
    if (hi < span->hi) {
        span->hi = hi;
        span->slope_hi = block_slope(world, block, ends_hi == wide_all(hi), line, &span->face_hi);
    }
}
#endif

/* Cuts the span down to what another, convex one holds. */
static inline void cut_span(Span* span, const Span* m)
{
    if (m->lo > span->lo) {
        span->lo = m->lo;
        span->slope_lo = m->slope_lo;
        span->chord = m->chord;
        span->face_lo = m->face_lo;
    }
    if (m->hi < span->hi) {
        span->hi = m->hi;
        span->slope_hi = m->slope_hi;
        span->face_hi = m->face_hi;
    }
}

/* The intersection of convex members, or a single member of any kind; turned inside out if the group says so. All
 * members come through one call, as some compilers copy what is called. */
static inline Span group_span(const World* world, const LayoutGroup group, const Line* line)
{
    Span span = span_everything();
    u32 i = 0;
    do {
        if (group.single) {
            const Span m = member_span(world, world->members[group.begin + i], line);
            if (i == 0)
                span = m;
            else
                cut_span(&span, &m);
        }
#ifdef CLU_PLANE
        for (u32 k = 0; i == 0 && k < group.block_count && span.lo < span.hi; k++)
            cut_block(world, &world->blocks[group.block_begin + k], line, &span);
#endif
    } while (++i < group.single && span.lo < span.hi);
    if (group.inverse) {
        span.keep = !span.keep;
        span.face_lo ^= MEMBER_INVERSE;
        span.face_hi ^= MEMBER_INVERSE;
    }
    return span_simplified(span);
}

/* Whether the span begins before x, or within rounding of it. Before its low end the line runs away from a curved
 * surface faster than the slope there tells: as much faster as the way is long beside the chord behind that end. */
static inline int passed_lo(const Span* s, real x, real doubt)
{
    const real ahead = s->lo - x;
    return passed(s->lo, s->slope_lo, x, doubt) &&
           (ahead <= R(0) || fma(ahead, ahead / s->chord, ahead) <= s->slope_lo * doubt);
}

/* Whether the span holds the point just after x, and after all ends that rounding cannot tell from x. */
static inline int span_holds(const Span* s, real x, real doubt)
{
    const int after_lo = passed_lo(s, x, doubt);
    const int after_hi = passed(s->hi, s->slope_hi, x, doubt);
    return (after_lo && !after_hi) == s->keep;
}

#ifdef CLU_GROUPS
static inline int object_holds(const World* world, __global const LayoutObject* object, const Span* spans, real x,
                               real doubt)
{
#ifdef CLU_PROGRAM
    if (object->program_count) {
        u32 bits = 0; /* the stack, its top at bit 0 */
        for (u32 i = 0; i < object->program_count; i++) {
            const u32 op = world->programs[object->program_begin + i];
            const u32 n = op >> OP_SHIFT;
            if ((op & OP_MASK) == OP_GROUP) {
                bits = bits << 1 | (u32)span_holds(&spans[n], x, doubt);
            } else {
                const u32 mask = (2u << (n - 1)) - 1u;
                const u32 top = bits & mask;
                const u32 value = (op & OP_MASK) == OP_AND ? top == mask : top != 0u;
                bits = n < 32 ? bits >> n << 1 | value : value;
            }
        }
        return (int)(bits & 1u);
    }
#endif
    for (u32 i = 0; i < object->group_count; i++)
        if (!span_holds(&spans[i], x, doubt)) return 0;
    return 1;
}

/* The end nearest to x at which the object is entered (or left). An empty span's yields to another that lies there but
 * for doubt: the ray passes flush faces outside of their solids. */
static inline Crossing nearest_face(const Span* spans, u32 count, real x, real doubt, int entering)
{
    Crossing best = {INFINITE, INFINITE, R(0), R(0), MEMBER_NONE};
    real nearest = INFINITE;
    for (u32 i = 0; i < count; i++) {
        const Span* s = &spans[i];
        const int at_lo = s->keep == entering, empty = s->keep && !(s->lo < s->hi);
        const real at = at_lo ? s->lo : s->hi, slope = at_lo ? s->slope_lo : s->slope_hi;
        const real away = fabs(at - x) + (empty ? slope * doubt : R(0));
        if (away < nearest) {
            nearest = away;
            best.at = at;
            best.slope = slope;
            best.face = at_lo ? s->face_lo : s->face_hi;
        }
    }
    return best;
}

/* The least end after x that has not been passed. */
static inline real next_end(const Span* spans, u32 count, real x, real doubt)
{
    real next = INFINITE;
    for (u32 i = 0; i < count; i++) {
        const Span s = spans[i];
        if (s.lo < next && !passed_lo(&s, x, doubt)) next = s.lo;
        if (s.hi < next && !passed(s.hi, s.slope_hi, x, doubt)) next = s.hi;
    }
    return next;
}
#endif

/* Where an object's next boundary is looked for: at ray parameter t, which is `at` on the object's line and known to
 * err; and whether the ray is inside the object there. */
typedef struct {
    real t, at, err;
    int inside;
} Place;

static inline Place place_at(const Line* line, real t, real err, int inside)
{
    Place p;
    p.t = t;
    p.at = line->start + t;
    p.err = err;
    p.inside = inside;
    return p;
}

/* A boundary that must lie right there, since the interior says one thing and geometry another. Within rounding it
 * does; beyond, the interior was wrong: the crossing then has no face, and is counted. */
static inline Crossing crossing_here(World* world, const Line* line, Crossing found, Place here)
{
    const real error = place_error(line, here.t, here.err);
    if (!(fabs(found.at - line->start - here.t) <= R(16) * larger(found.slope, R(1)) * error)) {
        COUNT(world, STAT_PARITY);
        found.face = MEMBER_NONE;
    }
    found.t = here.t;
    found.at = here.at;
    found.err = stored_error(line, found.at);
    return found;
}

/* Where the object's boundary is next crossed. Returns 1 and the crossing, or 0. */
static inline int object_crossing(World* world, __global const LayoutObject* object, const Line* line, Place place,
                                  Crossing* crossing)
{
    const int inside = place.inside;
    const real from = place.at, doubt = place_error(line, from, place.err);
    const u32 count = object->group_count;
    const int alone = count == 1 && !object->program_count;
    Span spans[CLU_GROUP_CAPACITY];
    u32 i = 0;
    do {
        const Span s = group_span(world, world->groups[object->group_begin + i], line);
        spans[i] = s;
        /* An intersection one of whose members has nothing ahead is done with. */
        if (!alone && !inside && !object->program_count && s.keep && !(s.lo < s.hi && s.hi >= from)) return 0;
    } while (++i < count);
#ifdef CLU_GROUPS
    if (!alone) {
        if (object_holds(world, object, spans, from, doubt) != inside) {
            *crossing = crossing_here(world, line, nearest_face(spans, count, from, doubt, !inside), place);
            return 1;
        }
        real at = from, here = doubt;
        do {
            at = next_end(spans, count, at, here);
            if (!(at < INFINITE)) return 0;
            here = place_error(line, at, R(0));
        } while (object_holds(world, object, spans, at, here) == inside);
        *crossing = nearest_face(spans, count, at, here, !inside);
        crossing->at = at;
        crossing->t = at - line->start;
        crossing->err = crossing_error(line, crossing);
        return 1;
    }
#endif
    const Span s = spans[0];
    const int at_lo = s.keep == !inside;
    crossing->at = at_lo ? s.lo : s.hi;
    crossing->slope = at_lo ? s.slope_lo : s.slope_hi;
    crossing->face = at_lo ? s.face_lo : s.face_hi;
    if (span_holds(&s, from, doubt) != inside) {
        *crossing = crossing_here(world, line, *crossing, place);
        return 1;
    }
    if (!is_finite(crossing->at)) return 0;
    if (at_lo && (passed_lo(&s, from, doubt) || passed(s.hi, s.slope_hi, s.lo, place_error(line, s.lo, R(0)))))
        return 0;
    crossing->t = crossing->at - line->start;
    crossing->err = crossing_error(line, crossing);
    return 1;
}

/* Whether the object holds the ray's start: on its boundary the ray's own side decides. */
static inline int object_holds_start(const World* world, __global const LayoutObject* object, const Line* line)
{
    const real doubt = place_error(line, line->start, line->err);
    Span spans[CLU_GROUP_CAPACITY];
    for (u32 i = 0; i < object->group_count; i++)
        spans[i] = group_span(world, world->groups[object->group_begin + i], line);
#ifdef CLU_GROUPS
    if (object->group_count > 1 || object->program_count) return object_holds(world, object, spans, line->start, doubt);
#endif
    return span_holds(&spans[0], line->start, doubt);
}

#endif
