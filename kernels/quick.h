/* The quick search: the next crossing in plain arithmetic, where no other lies so near that rounding could tell a
 * different story. Else it says that it is not sure, and the full search decides. */
#ifndef CLUCIDA_QUICK_H
#define CLUCIDA_QUICK_H

#include "kernels/csg.h"
#include "kernels/solids/quick.h"
#include "kernels/tree.h"

/* Tests switch it off, for the pictures must stay the same. */
#ifdef CLU_FULL_SEARCH
#define QUICK 0
#else
#define QUICK 1
#endif

/* A crossing at ray parameter t, right to within tolerance; or, if not sure, t is where doubt begins. */
typedef struct {
    real t, tolerance;
    u32 object;
    u32 face; /* as QuickSpan's */
    int sure;
} QuickCrossing;

/* The nearest crossing; where another is so near that this search cannot tell which is met first (tied), that one too.
 */
typedef struct {
    QuickCrossing first, rival;
    int tied;
    real spread; /* how far the surface may be from another that is crossed with it */
} QuickHit;

INLINED QuickSpan quick_member(const World* world, u32 member, const QuickLine* line)
{
    const int left = (member & ~MEMBER_INVERSE) == line->left;
    const u32 index = member >> MEMBER_SHIFT;
    QuickSpan span = quick_span(-INFINITE, INFINITE, QUICK_VAGUE, 1);
    switch (member & MEMBER_KIND) {
#ifdef CLU_PLANE
    case MEMBER_PLANE: span = quick_plane(&world->planes[index], line, left); break;
#endif
#ifdef CLU_SPHERE
    case MEMBER_SPHERE: span = quick_sphere(&world->spheres[index], line, left); break;
#endif
#ifdef CLU_QUADRIC
    case MEMBER_QUADRIC: span = quick_quadric(&world->quadrics[index], line, left); break;
#endif
    default: break; /* a torus has two intervals: vague */
    }
    if (member & MEMBER_INVERSE) span.keep = !span.keep;
    span.face_lo = span.face_hi = member;
    return span;
}

/* What both spans, that keep, hold. */
INLINED void quick_cut(QuickSpan* span, const QuickSpan* by)
{
    if (by->lo > span->lo) {
        span->lo = by->lo;
        span->face_lo = by->face_lo;
        span->marks = (span->marks & ~QUICK_LEFT_LO) | (by->marks & QUICK_LEFT_LO);
    }
    if (by->hi < span->hi) {
        span->hi = by->hi;
        span->face_hi = by->face_hi;
        span->marks = (span->marks & ~QUICK_LEFT_HI) | (by->marks & QUICK_LEFT_HI);
    }
    span->marks |= by->marks & QUICK_VAGUE;
}

/* Inside out. One that then starts or ends nowhere keeps one side of an end; where that is vague, nothing is known. */
INLINED QuickSpan quick_complement(QuickSpan s)
{
    s.keep = !s.keep;
    if (s.keep || (s.lo > -INFINITE && s.hi < INFINITE)) return s;
    s.keep = 1;
    if (s.marks & QUICK_VAGUE) {
        s.lo = -INFINITE;
        s.hi = INFINITE;
    } else if (s.lo > -INFINITE) {
        s.hi = s.lo;
        s.face_hi = s.face_lo;
        s.lo = -INFINITE;
        s.marks = s.marks << 1;
    } else if (s.hi < INFINITE) {
        s.lo = s.hi;
        s.face_lo = s.face_hi;
        s.hi = INFINITE;
        s.marks = s.marks >> 1;
    } else {
        s.lo = INFINITE;
        s.hi = -INFINITE;
    }
    return s;
}

/* The span of an object's group; one that does not keep has two ends. Of several members a sphere comes first, which is
 * likely to hold all the rest, then the planes. */
INLINED QuickSpan quick_group(const World* world, __global const LayoutObject* object, u32 number,
                              const QuickLine* line)
{
    const u32 sole = object->sole;
    LayoutGroup group = {0, 1, 1, 0, 0, 0}; /* of a sole member */
    if (sole == MEMBER_NONE) group = world->groups[object->group_begin + number];
    const u32 single = group.single;
    QuickSpan s = quick_span(-INFINITE, INFINITE, 0, 1);
#ifdef CLU_PLANE
    const int sphere = group.block_count && single && (world->members[group.begin] & MEMBER_KIND) == MEMBER_SPHERE;
    const u32 blocks_at = sphere ? 1u : 0u;
    for (u32 i = 0; i <= single && s.lo < s.hi; i++) {
        for (u32 k = 0; i == blocks_at && k < group.block_count && s.lo < s.hi; k++)
            quick_block(&world->blocks[group.block_begin + k], group.block_begin + k, line, &s);
        if (i == single) break;
#else
    for (u32 i = 0; i < single && s.lo < s.hi; i++) {
#endif
        const QuickSpan m = quick_member(world, sole != MEMBER_NONE ? sole : world->members[group.begin + i], line);
        if (group.count == 1)
            s = m;
        else
            quick_cut(&s, &m);
    }
    if (fabs(s.hi - s.lo) < line->tolerance) {
        s.lo -= line->tolerance;
        s.hi += line->tolerance;
        s.marks |= QUICK_VAGUE;
    }
    if (group.inverse) {
        s = quick_complement(s);
        s.face_lo ^= MEMBER_INVERSE;
        s.face_hi ^= MEMBER_INVERSE;
    }
    return s;
}

/* What an object holds of a line, or does not: one interval less some. */
#define QUICK_GAPS (CLU_GROUP_CAPACITY < 8 ? CLU_GROUP_CAPACITY : 8)
typedef struct {
    QuickSpan whole;
    u32 gap_count;
    QuickSpan gaps[QUICK_GAPS];
} QuickSolid;

INLINED int quick_unsure(QuickCrossing* c, real at)
{
    c->t = at;
    c->sure = 0;
    return 1;
}

INLINED int quick_end(QuickCrossing* c, real at, u32 face)
{
    c->t = at;
    c->face = face;
    c->sure = 1;
    return 1;
}

/* Where the solid is entered from `from` on, which it does not hold: where it ends about there it lies behind, and a
 * gap that begins about there holds the ray, if no other one ends there. */
INLINED int quick_entry(const QuickSolid* solid, real from, real tolerance, QuickCrossing* c)
{
    const QuickSpan* whole = &solid->whole;
    if (whole->hi < from - tolerance || (whole->marks & QUICK_LEFT_HI && whole->hi == from)) return 0;
    if (whole->hi < from + tolerance && whole->lo < from - tolerance && !(whole->marks & QUICK_VAGUE)) return 0;
    if (whole->marks & QUICK_VAGUE || whole->hi < larger(whole->lo, from) + tolerance)
        return quick_unsure(c, larger(smaller(whole->lo, whole->hi) - tolerance, from));
    quick_end(c, whole->lo, whole->face_lo);
    /* Within the whole the ray must begin in a gap. */
    int in_gap = whole->lo > from + tolerance, ends = 0;
    if (!in_gap) {
        if (whole->lo > from - tolerance) return quick_unsure(c, from);
        c->t = from;
        for (u32 i = 0; i < solid->gap_count; i++) ends |= fabs(solid->gaps[i].hi - from) <= tolerance;
    }
    u32 gap = solid->gap_count;
    for (u32 i = 0; i < solid->gap_count; i++) {
        const QuickSpan* g = &solid->gaps[i];
        if (i == gap || g->lo > c->t + tolerance || g->hi < c->t - tolerance) continue;
        const int here = c->t == from && (!ends || (g->lo == from && g->marks & QUICK_LEFT_LO));
        if (g->marks & QUICK_VAGUE || g->hi < c->t + tolerance || (g->lo > c->t - tolerance && !here))
            return quick_unsure(c, c->t);
        quick_end(c, g->hi, g->face_hi);
        in_gap = 1;
        gap = i;
        i = 0xffffffffu; /* others may begin within this one */
    }
    if (!in_gap) return quick_unsure(c, from);
    if (c->t > whole->hi + tolerance) return 0;
    return c->t < whole->hi - tolerance ? 1 : quick_unsure(c, whole->hi - tolerance);
}

/* Where the solid is left from `from` on. */
INLINED int quick_exit(const QuickSolid* solid, real from, real tolerance, QuickCrossing* c)
{
    const QuickSpan* whole = &solid->whole;
    if (whole->marks & QUICK_VAGUE || whole->lo > from + tolerance || !(whole->hi > from + tolerance))
        return quick_unsure(c, from);
    quick_end(c, whole->hi, whole->face_hi);
    real second = INFINITE;
    for (u32 i = 0; i < solid->gap_count; i++) {
        const QuickSpan* g = &solid->gaps[i];
        if (g->hi < from + tolerance && g->lo < from - tolerance && !(g->marks & QUICK_VAGUE)) continue;
        if (g->lo < from + tolerance) return quick_unsure(c, from);
        if (g->marks & QUICK_VAGUE) {
            second = smaller(second, g->lo);
        } else if (g->lo < c->t) {
            second = smaller(second, c->t);
            quick_end(c, g->lo, g->face_lo);
        } else {
            second = smaller(second, g->lo);
        }
    }
    return second > c->t + tolerance ? 1 : quick_unsure(c, smaller(c->t, second));
}

/* Where a ray crosses an object's boundary: 0 if nowhere. inside: whether it starts inside. */
static CALLED int quick_crossing(const World* world, u32 id, const Ray* ray, int inside, QuickCrossing* c)
{
    __global const LayoutObject* object = &world->objects[id];
    const QuickLine line = quick_line(ray, object);
    const int any = object->form == FORM_ANY;
    QuickSolid solid;
    solid.whole = quick_span(-INFINITE, INFINITE, 0, 1);
    solid.gap_count = 0;
    c->object = id;
    c->tolerance = line.tolerance;
    if (object->form == FORM_PROGRAM) return quick_unsure(c, R(0));
    for (u32 i = 0; i < object->group_count; i++) {
        QuickSpan s = quick_group(world, object, i, &line);
        if (any) s = quick_complement(s);
        if (s.keep)
            quick_cut(&solid.whole, &s);
        else if (!(s.lo < s.hi))
            continue;
        else if (solid.gap_count == QUICK_GAPS)
            return quick_unsure(c, R(0));
        else
            solid.gaps[solid.gap_count++] = s;
        if (inside == any &&
            (solid.whole.lo > solid.whole.hi + line.tolerance || solid.whole.hi < line.start - line.tolerance))
            return 0;
    }
    const int met = inside != any ? quick_exit(&solid, line.start, line.tolerance, c)
                                  : quick_entry(&solid, line.start, line.tolerance, c);
    c->t -= line.start;
    return met;
}

/* Whether the object holds the point just after ray parameter t: 1 or 0; -1 if that is not sure, QUICK_ENTERED or
 * QUICK_LEAVES if it depends on *end alone, where the object is entered or left. */
#define QUICK_ENTERED 2
#define QUICK_LEAVES 3
static CALLED int quick_holds(const World* world, u32 id, const Ray* ray, real t, QuickCrossing* end)
{
    __global const LayoutObject* object = &world->objects[id];
    const QuickLine line = quick_line(ray, object);
    const real at = t + line.start;
    const int any = object->form == FORM_ANY;
    int depends = 0;
    if (object->form == FORM_PROGRAM) return -1;
    end->object = id;
    end->t = t;
    end->tolerance = R(2) * line.tolerance;
    for (u32 i = 0; i < object->group_count; i++) {
        const QuickSpan s = quick_group(world, object, i, &line);
        const int vague = (s.marks & QUICK_VAGUE) != 0u;
        const int about = at >= s.lo - line.tolerance && at <= s.hi + line.tolerance;
        const int at_lo = about && at <= s.lo + line.tolerance, at_hi = about && at >= s.hi - line.tolerance;
        if (at_lo || at_hi || (vague && about)) {
            depends = vague || at_lo == at_hi || depends ? -1 : at_lo == s.keep ? QUICK_ENTERED : QUICK_LEAVES;
            end->face = at_lo ? s.face_lo : s.face_hi;
        } else if (((s.lo < at && at < s.hi) == s.keep) == any) {
            return any;
        }
    }
    return depends ? depends : !any;
}

/* Looks at one more object: the nearest crossing stays in *hit. */
INLINED void quick_try(World* world, u32 id, const Ray* ray, int inside, QuickHit* hit)
{
    QuickCrossing c;
    QuickCrossing* first = &hit->first;
    COUNT(world, STAT_TESTS);
    if (!quick_crossing(world, id, ray, inside, &c)) return;
    const real apart = larger(c.tolerance, first->tolerance);
    if (c.t < first->t - apart || first->t == INFINITE) {
        *first = c;
        hit->tied = 0;
    } else if (c.t <= first->t + apart) {
        const int sure = c.sure && first->sure && !hit->tied; /* a third one is too many */
        hit->rival = c.t < first->t ? *first : c;
        if (c.t < first->t) *first = c;
        first->tolerance = hit->rival.tolerance = apart;
        first->sure = sure;
        hit->tied = 1;
    }
}

/* The end of the solid that the full search would have found there. */
INLINED int confirm(const World* world, const Ray* ray, const QuickCrossing* quick, Crossing* crossing)
{
    const Line line = make_line(ray, &world->objects[quick->object]);
    const u32 number = quick->face >> MEMBER_SHIFT;
    Span span = span_everything();
#ifdef CLU_PLANE
    if (quick->face & QUICK_BLOCK)
        cut_block(world, &world->blocks[number & ~(QUICK_BLOCK >> MEMBER_SHIFT)], &line, &span);
    else
#endif
        span = member_span(world, quick->face & ~MEMBER_INVERSE, &line);
    const real at = quick->t + line.start;
    const int at_hi = fabs(span.hi - at) < fabs(span.lo - at);
    crossing->at = at_hi ? span.hi : span.lo;
    crossing->slope = at_hi ? span.slope_hi : span.slope_lo;
    crossing->face = (at_hi ? span.face_hi : span.face_lo) | (quick->face & MEMBER_INVERSE);
    crossing->t = crossing->at - line.start;
    crossing->err = crossing_error(&line, crossing);
    return fabs(crossing->t - quick->t) <= quick->tolerance;
}

/* Of two ends that lie near each other: whether a comes first (-1), b does (1), or rounding cannot tell, so that they
 * are crossed as one (0); END_UNKNOWN if they are not where the quick search has them. *spread: how far each may then
 * be from a place on the other. */
#define END_UNKNOWN 2
static CALLED int end_order(const World* world, const Ray* ray, const QuickCrossing* a, const QuickCrossing* b,
                            real* spread)
{
    Crossing one, other;
    if (!confirm(world, ray, a, &one) || !confirm(world, ray, b, &other)) return END_UNKNOWN;
    *spread = fabs(one.t - other.t) / larger(smaller(one.slope, other.slope), R(1));
    if (one.t <= other.t) return coincides(one, other) ? 0 : -1;
    return coincides(other, one) ? 0 : 1;
}

/* Of two boundaries that are near each other the robust arithmetic tells which is met. Both at once are as one of the
 * object that has precedence: no more than one of them can be the medium's, which is left, so the other is entered. */
INLINED void quick_untie(const World* world, const Ray* ray, QuickHit* hit)
{
    real spread = R(0);
    const int order = end_order(world, ray, &hit->first, &hit->rival, &spread);
    if (order == END_UNKNOWN)
        hit->first.sure = 0;
    else if (order > 0 || (order == 0 && hit->rival.object < hit->first.object))
        hit->first = hit->rival;
    if (order == 0) hit->spread = spread;
}

/* Where a ray in a medium next leaves it, or enters what has precedence over it: t is infinite if nowhere. What is
 * below the medium is not there as long as that lasts. */
INLINED QuickHit quick_nearest(World* world, const Ray* ray, u32 medium)
{
    QuickHit hit;
    hit.first.t = INFINITE;
    hit.first.tolerance = R(0);
    hit.first.sure = QUICK;
    hit.tied = 0;
    hit.spread = R(0);
    if (!QUICK) hit.first.t = R(0);
    Walk walk;
    walk_begin(&walk, ray);
    for (int inside = medium != VACUUM; hit.first.sure || hit.first.t > hit.first.tolerance; inside = 0) {
        const u32 id = inside ? medium : walk_next(&walk, world, -ray->err, hit.first.t + hit.first.tolerance);
        if (id == WALK_DONE) break;
        if (inside || id < medium) quick_try(world, id, ray, inside, &hit);
    }
    if (hit.tied && hit.first.sure) quick_untie(world, ray, &hit);
    return hit;
}

/* Whether an object holds the points beyond the medium's end, which lies near *end of the object's own: 1, 0 or -1.
 * Where both are left the full search looks whether one is entered again. */
INLINED int holds_beyond(const World* world, const Ray* ray, QuickHit* left, const QuickCrossing* end, int entered)
{
    real spread = R(0);
    if (left->tied) return -1;
    left->tied = 1;
    const int order = end_order(world, ray, &left->first, end, &spread);
    if (order == END_UNKNOWN || (order == 0 && !entered)) return -1;
    if (order == 0) left->spread = spread;
    return entered == (order >= 0);
}

/* The first object below `above` that holds the point just after ray parameter t, or VACUUM; 0 if that is not sure.
 * left: the crossing at t, or NULL if there is none. */
INLINED int quick_medium(World* world, const Ray* ray, real t, u32 above, QuickHit* left, u32* medium)
{
    Walk walk;
    walk_begin(&walk, ray);
    *medium = VACUUM;
    while (QUICK) {
        const u32 id = walk_next(&walk, world, t, t);
        if (id == WALK_DONE) return 1;
        if (id >= *medium || (above != VACUUM && id <= above)) continue;
        COUNT(world, STAT_TESTS);
        QuickCrossing end;
        int holds = quick_holds(world, id, ray, t, &end);
        if (holds > 1) holds = left ? holds_beyond(world, ray, left, &end, holds == QUICK_ENTERED) : -1;
        if (holds < 0) return 0;
        if (holds) *medium = id;
    }
    return 0;
}

#endif
