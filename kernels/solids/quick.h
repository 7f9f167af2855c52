/* What solids hold of a line, in plain arithmetic: for the quick search (quick.h), which asks the full one where an end
 * is in doubt. Ends that are met at so small an angle that rounding moves them by more than the quick search's
 * tolerance are vague: they lie outwards by as much as they may be off. */
#ifndef CLUCIDA_SOLIDS_QUICK_H
#define CLUCIDA_SOLIDS_QUICK_H

#include "kernels/line.h"
#include "kernels/wide.h"

/* The ray relative to an object's centre, from its point nearest to that. */
typedef struct {
    vec base, d, origin;
    real start;     /* parameter of the ray's origin */
    real error;     /* of what is computed from these, as a length */
    real tolerance; /* between ends: what the error makes of them at the least angle that is not vague */
    u32 left;
    int left_inside;
} QuickLine;

/* 1/cos of the angle at which an end is vague. */
#define QUICK_SLOPE R(64)
/* Roundings that an end may be off by, of the numbers' size, if it is met at right angles. */
#define QUICK_ROUNDINGS R(8)

typedef struct {
    real lo, hi;
    u32 face_lo, face_hi; /* a reference, or QUICK_BLOCK and a block: of one of its planes */
    u32 marks;            /* QUICK_* bits */
    int keep;             /* inside is lo..hi; else inside is all but lo..hi */
} QuickSpan;
#define QUICK_VAGUE_LO 1u
#define QUICK_VAGUE_HI 2u
#define QUICK_VAGUE (QUICK_VAGUE_LO | QUICK_VAGUE_HI)
#define QUICK_LEFT_LO 4u /* the end is where the ray left the solid; of LO and HI the latter is the former << 1 */
#define QUICK_LEFT_HI 8u
#define QUICK_BLOCK 0x80000000u

INLINED QuickLine quick_line(const Ray* ray, __global const LayoutObject* object)
{
    QuickLine l;
    l.origin = sub(ray->o, load_vec(object->center));
    l.d = ray->d;
    l.start = dot3(l.origin, l.d);
    l.base = along(l.origin, l.d, -l.start);
    const real size = fabs(l.start) + largest(l.base) + R(object->grain);
    l.error = fma(QUICK_ROUNDINGS * R(STORED_ROUNDOFF), size, ray->err);
    l.tolerance = QUICK_SLOPE * l.error;
    l.left = ray->left;
    l.left_inside = ray->left_inside;
    return l;
}

INLINED QuickSpan quick_span(real lo, real hi, u32 marks, int keep)
{
    QuickSpan s;
    s.lo = lo;
    s.hi = hi;
    s.face_lo = s.face_hi = MEMBER_NONE;
    s.marks = marks;
    s.keep = keep;
    return s;
}

INLINED QuickSpan quick_left(const QuickLine* l)
{
    return l->left_inside ? quick_span(l->start, INFINITE, QUICK_LEFT_LO, 1)
                          : quick_span(-INFINITE, l->start, QUICK_LEFT_HI, 1);
}

/* The chord of a ray that has left the solid and meets it again. */
INLINED QuickSpan quick_chord(const QuickLine* l, real length, int vague)
{
    vague = vague || !(length > l->tolerance);
    return quick_span(l->start, l->start + length, QUICK_LEFT_LO | (vague ? QUICK_VAGUE_HI : 0u), l->left_inside);
}

/* Cuts the span down to a block of planes. A plane that is met at a small angle is pushed outwards by the error; where
 * it would cut the span if it were pushed inwards, that is vague. */
INLINED void quick_block(__global const LayoutPlaneBlock* block, u32 number, const QuickLine* l, QuickSpan* span)
{
    const wide x = load_wide(block->n[0]), y = load_wide(block->n[1]), z = load_wide(block->n[2]);
    wide nd = wide_fma(x, wide_all(l->d.x), wide_fma(y, wide_all(l->d.y), z * wide_all(l->d.z)));
    const wide n_base = wide_fma(x, wide_all(l->base.x), wide_fma(y, wide_all(l->base.y), z * wide_all(l->base.z)));
    wide height = n_base - load_wide(block->h);
    const wide zero = wide_all(R(0)), infinite = wide_all(INFINITE), least = wide_all(R(1e-30f));
    nd = wide_select(nd, least, wide_fabs(nd) < least);
    wide_mask flat = wide_fabs(nd) < wide_all(R(1) / QUICK_SLOPE);
    height = height - wide_select(zero, wide_all(l->error), flat);
    const wide over = wide_all(R(1)) / nd, t = -height * over;
    const wide_mask enters = nd < zero;
    wide lo = wide_select(-infinite, t, enters), hi = wide_select(t, infinite, enters);
    u32 left_lanes = 0;
    if ((l->left & MEMBER_KIND) == MEMBER_PLANE) {
        const wide_mask left = wide_is(load_wide_u32(block->plane), l->left >> MEMBER_SHIFT);
        const wide start = wide_all(l->start);
        lo = wide_select(lo, l->left_inside ? start : -infinite, left);
        hi = wide_select(hi, l->left_inside ? infinite : start, left);
        flat = flat & ~left;
        left_lanes = wide_bits(left);
    }
    const real low = wide_largest(lo), high = wide_smallest(hi);
    if (low > span->lo) {
        span->lo = low;
        span->face_lo = QUICK_BLOCK | number << MEMBER_SHIFT;
        if (left_lanes && low == l->start) span->marks |= QUICK_LEFT_LO;
    }
    if (high < span->hi) {
        span->hi = high;
        span->face_hi = QUICK_BLOCK | number << MEMBER_SHIFT;
        if (left_lanes && high == l->start) span->marks |= QUICK_LEFT_HI;
    }
    const wide inwards = wide_fma(wide_all(R(-2) * l->error), over, t);
    const wide_mask cuts = (enters & (inwards > wide_all(span->lo))) | (~enters & (inwards < wide_all(span->hi)));
    if (wide_bits(flat & cuts)) span->marks |= QUICK_VAGUE;
}

INLINED QuickSpan quick_plane(__global const LayoutPlane* plane, const QuickLine* l, int left)
{
    if (left) return quick_left(l);
    const vec n = load_vec(plane->n);
    real nd = dot3(n, l->d);
    if (fabs(nd) < R(1e-30f)) nd = R(1e-30f);
    const int flat = fabs(nd) < R(1) / QUICK_SLOPE;
    const real t = ((flat ? l->error : R(0)) - (dot3(n, l->base) - R(plane->h))) / nd;
    return nd < R(0) ? quick_span(t, INFINITE, flat ? QUICK_VAGUE : 0u, 1)
                     : quick_span(-INFINITE, t, flat ? QUICK_VAGUE : 0u, 1);
}

INLINED QuickSpan quick_sphere(__global const LayoutSphere* sphere, const QuickLine* l, int left)
{
    const vec c = load_vec(sphere->c);
    const real r = R(sphere->r);
    if (left) {
        const real b = dot3(sub(l->origin, c), l->d);
        return l->left_inside ? quick_chord(l, R(-2) * b, !(fabs(b) * QUICK_SLOPE > r)) : quick_left(l);
    }
    const vec o = sub(l->base, c);
    const real b = dot3(o, l->d);
    const vec p = along(o, l->d, -b);
    const real discriminant = fma(r, r, -dot3(p, p));
    /* As small as at a slope of QUICK_SLOPE, or as what the error of p makes of it. */
    const real doubt = r * fma(r, R(1) / (QUICK_SLOPE * QUICK_SLOPE), R(4) * l->error);
    if (discriminant < -doubt) return quick_span(INFINITE, -INFINITE, 0, 1);
    const real half_chord = sqrt(larger(discriminant, R(0)) + doubt);
    if (discriminant < doubt) return quick_span(-b - half_chord, half_chord - b, QUICK_VAGUE, 1);
    const real root = sqrt(discriminant);
    return quick_span(-b - root, root - b, 0, 1);
}

#ifdef CLU_QUADRIC
INLINED vec quick_gradient(__global const LayoutQuadric* q, vec x)
{
    return make_vec(R(q->s[0]) * x.x, R(q->s[1]) * x.y, fma(R(q->s[2]), x.z, R(-q->g)));
}

INLINED QuickSpan quick_quadric(__global const LayoutQuadric* q, const QuickLine* l, int left)
{
    const vec d = apply(q->m, l->d), s = load_vec(q->s), sd = make_vec(s.x * d.x, s.y * d.y, s.z * d.z);
    const real a = dot3(sd, d), dd = dot3(d, d), norm = square(R(q->norm)), vague_a = R(1e-3f) * dd;
    const int convex = s.x >= R(0) && s.y >= R(0) && s.z >= R(0);
    if (left && convex && !l->left_inside) return quick_left(l);
    const vec x = apply(q->m, sub(left ? l->origin : l->base, load_vec(q->c)));
    const vec gradient = quick_gradient(q, x);
    const real b = dot3(gradient, d);
    if (left) {
        if (!(fabs(a) > vague_a)) return quick_span(-INFINITE, INFINITE, QUICK_VAGUE, 1);
        if ((a > R(0)) != (l->left_inside != 0)) return quick_left(l);
        return quick_chord(l, R(-2) * b / a, !(square(b * QUICK_SLOPE) > norm * dot3(gradient, gradient)));
    }
    if (!(fabs(a) > vague_a)) return quick_span(-INFINITE, INFINITE, QUICK_VAGUE, 1);
    const vec k = make_vec(fma(x.y, d.z, -x.z * d.y), fma(x.z, d.x, -x.x * d.z), fma(x.x, d.y, -x.y * d.x));
    const real g = R(q->g), up = g * d.z, across = s.x * d.x * k.y - s.y * d.y * k.x;
    const real moment = fma(s.x * s.y * k.z, k.z, fma(s.y * s.z * k.x, k.x, s.x * s.z * k.y * k.y));
    const real discriminant = fma(up, up, fma(R(2) * g, across, -moment - R(q->w) * a));
    /* The gradient halfway between the ends tells how steep they are. */
    const real over = R(1) / a, middle = -b * over;
    const vec halfway = along(gradient, sd, middle);
    const real steep = norm * fma(dot3(sd, sd), larger(discriminant, R(0)) * over * over, dot3(halfway, halfway));
    const real doubt =
        fma(steep, R(2) / (QUICK_SLOPE * QUICK_SLOPE), norm * square(l->tolerance) * larger(fabs(a), norm));
    if (discriminant < -doubt)
        return a < R(0) ? quick_span(-INFINITE, INFINITE, 0, 1) : quick_span(INFINITE, -INFINITE, 0, 1);
    const int vague = discriminant < doubt;
    const real reach = sqrt(larger(discriminant, R(0)) + (vague ? doubt : R(0))) * fabs(over);
    return quick_span(middle - reach, middle + reach, vague ? QUICK_VAGUE : 0u, a > R(0));
}
#endif

#endif
