/* What single solids hold of a packet's lines: as kernels/solids/quick.h has it of one line, with the same tolerance.
 */
#ifndef CLUCIDA_PACKETS_SPANS_H
#define CLUCIDA_PACKETS_SPANS_H

#include "kernels/packets/lanes.h"
#include "kernels/solids/quick.h"

/* The rays of a packet, as one object after the other sees them. */
typedef struct {
    wide_vec o, d; /* the same for all */
    wide err;
    wide_id left; /* a reference's bits */
    wide_mask left_inside;
    wide_vec origin, base; /* relative to the object's centre */
    wide start, error, tolerance;
} PacketLine;

/* The ends of a solid on the lines. One that is vague lies somewhere between lo and lo_in, or hi_in and hi; if lo_in is
 * beyond hi_in, there may be nothing between the ends. */
typedef struct {
    wide lo, hi, lo_in, hi_in;
    wide_id face_lo, face_hi;
    wide_mask keep; /* inside is lo..hi; else inside is all but lo..hi */
} PacketSpan;

INLINED PacketSpan packet_span(real lo, real hi)
{
    PacketSpan s;
    s.lo = s.lo_in = wide_all(lo);
    s.hi = s.hi_in = wide_all(hi);
    s.face_lo = s.face_hi = all_ids((int)MEMBER_NONE);
    s.keep = all_ids(-1);
    return s;
}

/* Where the lines may meet nothing at all. */
INLINED void packet_vague(PacketSpan* s, wide_mask vague)
{
    s->lo_in = where(vague, wide_all(INFINITE), s->lo);
    s->hi_in = where(vague, wide_all(-INFINITE), s->hi);
}

/* Where rays have left the solid and meet it no more, or (chord) meet it again. */
INLINED void packet_left(const PacketLine* l, wide_mask left, PacketSpan* s)
{
    const wide lo = where(l->left_inside, l->start, wide_all(-INFINITE));
    const wide hi = where(l->left_inside, wide_all(INFINITE), l->start);
    s->lo = where(left, lo, s->lo);
    s->hi = where(left, hi, s->hi);
    s->lo_in = where(left, lo, s->lo_in);
    s->hi_in = where(left, hi, s->hi_in);
    s->keep |= left;
}
INLINED void packet_chord(const PacketLine* l, wide_mask chord, wide length, wide_mask vague, PacketSpan* s)
{
    const wide hi = l->start + length;
    s->lo = where(chord, l->start, s->lo);
    s->lo_in = where(chord, l->start, s->lo_in);
    s->hi = where(chord, hi, s->hi);
    s->hi_in = where(chord, where(vague | ~(length > l->tolerance), l->start, hi), s->hi_in);
    s->keep = where_id(chord, l->left_inside, s->keep);
}

#ifdef CLU_PLANE
/* Cuts the span down to what lies behind a plane. */
INLINED void packet_plane(__global const LayoutPlane* plane, u32 member, const PacketLine* l, PacketSpan* s)
{
    const wide zero = wide_all(R(0)), least = wide_all(R(1e-30f));
    wide nd = wide_dot_shared(plane->n, l->d);
    nd = where(wide_fabs(nd) < least, least, nd);
    const wide_mask flat = wide_fabs(nd) < wide_all(R(1) / QUICK_SLOPE);
    const wide height = wide_dot_shared(plane->n, l->base) - wide_all(R(plane->h)) - where(flat, l->error, zero);
    const wide over = wide_all(R(1)) / nd, t = -height * over;
    const wide_mask enters = nd < zero, left = wide_is(l->left, member);
    wide lo = where(enters, t, wide_all(-INFINITE)), hi = where(enters, wide_all(INFINITE), t), lo_in = lo, hi_in = hi;
    if (any_lane(flat)) {
        const wide inner = wide_fma(R(-2) * l->error, over, t);
        lo_in = where(flat & enters, inner, lo);
        hi_in = where(flat & ~enters, inner, hi);
    }
    if (any_lane(left)) {
        lo = where(left, where(l->left_inside, l->start, wide_all(-INFINITE)), lo);
        hi = where(left, where(l->left_inside, wide_all(INFINITE), l->start), hi);
        lo_in = where(left, lo, lo_in);
        hi_in = where(left, hi, hi_in);
    }
    const wide_mask later = lo > s->lo, sooner = hi < s->hi;
    const wide_id face = all_ids((int)member);
    s->lo = where(later, lo, s->lo);
    s->hi = where(sooner, hi, s->hi);
    s->face_lo = where_id(later, face, s->face_lo);
    s->face_hi = where_id(sooner, face, s->face_hi);
    s->lo_in = wide_larger(lo_in, s->lo_in);
    s->hi_in = wide_smaller(hi_in, s->hi_in);
}
#endif

#ifdef CLU_PLANE
/* Whether two planes face away from each other: what lies behind both is a slab. */
INLINED int are_opposite(__global const LayoutPlane* a, __global const LayoutPlane* b)
{
    return a->n[0] == -b->n[0] && a->n[1] == -b->n[1] && a->n[2] == -b->n[2];
}

/* Cuts the span down to what lies behind both of two opposite planes, references a and b: as packet_plane twice, for
 * little more than the price of one. */
INLINED void packet_slab(const World* world, u32 a, u32 b, const PacketLine* l, PacketSpan* s)
{
    __global const LayoutPlane *one = &world->planes[a >> MEMBER_SHIFT], *other = &world->planes[b >> MEMBER_SHIFT];
    const wide zero = wide_all(R(0)), least = wide_all(R(1e-30f));
    wide nd = wide_dot_shared(one->n, l->d);
    nd = where(wide_fabs(nd) < least, least, nd);
    const wide_mask flat = wide_fabs(nd) < wide_all(R(1) / QUICK_SLOPE), enters = nd < zero;
    const wide height = wide_dot_shared(one->n, l->base), over = wide_all(R(1)) / nd;
    wide t_one = (wide_all(R(one->h)) - height) * over;
    wide t_other = (wide_all(R(-other->h)) - height) * over;
    const wide_mask left_one = wide_is(l->left, a), left_other = wide_is(l->left, b), left = left_one | left_other;
    /* A ray that has left a plane starts on it, and goes to the side that it went to, whatever its direction says. */
    const wide_mask odd = left & (enters ^ left_one ^ ~l->left_inside), front = enters ^ odd;
    if (any_lane(left)) {
        t_one = where(left_one, l->start, t_one);
        t_other = where(left_other, l->start, t_other);
    }
    wide lo = where(front, t_one, t_other), hi = where(front, t_other, t_one);
    if (any_lane(odd)) {
        lo = where(odd & ~l->left_inside, wide_all(-INFINITE), lo);
        hi = where(odd & l->left_inside, wide_all(INFINITE), hi);
    }
    wide lo_in = lo, hi_in = hi;
    if (any_lane(flat)) {
        const wide off = where(flat, l->error * wide_fabs(over), zero);
        const wide off_lo = where(left & l->left_inside, zero, off), off_hi = where(left & ~l->left_inside, zero, off);
        lo_in = lo + off_lo;
        hi_in = hi - off_hi;
        lo = lo - off_lo;
        hi = hi + off_hi;
    }
    const wide_mask later = lo > s->lo, sooner = hi < s->hi;
    const wide_id face_one = all_ids((int)a), face_other = all_ids((int)b);
    s->lo = where(later, lo, s->lo);
    s->hi = where(sooner, hi, s->hi);
    s->face_lo = where_id(later, where_id(front, face_one, face_other), s->face_lo);
    s->face_hi = where_id(sooner, where_id(front, face_other, face_one), s->face_hi);
    s->lo_in = wide_larger(lo_in, s->lo_in);
    s->hi_in = wide_smaller(hi_in, s->hi_in);
}
#endif

#ifdef CLU_SPHERE
INLINED void packet_sphere(__global const LayoutSphere* sphere, u32 member, const PacketLine* l, PacketSpan* s)
{
    const real r = R(sphere->r);
    const wide zero = wide_all(R(0));
    const wide_vec o = wide_less(l->base, sphere->c);
    const wide b = wide_dot(o, l->d);
    const wide_vec p = wide_along(o, l->d, -b);
    const wide discriminant = wide_fma(wide_all(r), wide_all(r), -wide_dot(p, p));
    const wide doubt = r * wide_fma(wide_all(R(4)), l->error, wide_all(r / (QUICK_SLOPE * QUICK_SLOPE)));
    const wide_mask none = discriminant < -doubt, near = discriminant < doubt;
    const wide half_chord = wide_sqrt(wide_larger(discriminant, zero) + where(near, doubt, zero));
    s->lo = where(none, wide_all(INFINITE), -b - half_chord);
    s->hi = where(none, wide_all(-INFINITE), half_chord - b);
    packet_vague(s, near & ~none);
    const wide_mask left = wide_is(l->left, member);
    if (any_lane(left)) {
        const wide back = wide_dot(wide_less(l->origin, sphere->c), l->d);
        packet_left(l, left, s);
        packet_chord(l, left & l->left_inside, R(-2) * back, ~(wide_fabs(back) * QUICK_SLOPE > wide_all(r)), s);
    }
}
#endif

#ifdef CLU_QUADRIC
INLINED wide_vec packet_gradient(__global const LayoutQuadric* q, wide_vec x)
{
    return make_wide_vec(R(q->s[0]) * x.x, R(q->s[1]) * x.y, wide_fma(wide_all(R(q->s[2])), x.z, wide_all(R(-q->g))));
}

INLINED void packet_quadric(__global const LayoutQuadric* q, u32 member, const PacketLine* l, PacketSpan* s)
{
    const wide zero = wide_all(R(0));
    const real sx = R(q->s[0]), sy = R(q->s[1]), sz = R(q->s[2]), g = R(q->g), norm = square(R(q->norm));
    const wide_vec d = wide_apply(q->m, l->d), sd = make_wide_vec(sx * d.x, sy * d.y, sz * d.z);
    const wide a = wide_dot(sd, d), over = wide_all(R(1)) / a;
    const wide dd = wide_dot(d, d);
    const wide_mask flat = ~(wide_fabs(a) > R(1e-5f) * dd), flattish = ~(wide_fabs(a) > R(1e-3f) * dd);
    const wide_vec x = wide_apply(q->m, wide_less(l->base, q->c)), gradient = packet_gradient(q, x);
    const wide b = wide_dot(gradient, d);
    const wide c = wide_fma(wide_fma(wide_all(sz), x.z, wide_all(R(-2) * g)), x.z,
                            wide_fma(sx * x.x, x.x, wide_fma(sy * x.y, x.y, wide_all(R(q->w)))));
    const wide kx = wide_fma(x.y, d.z, -x.z * d.y), ky = wide_fma(x.z, d.x, -x.x * d.z),
               kz = wide_fma(x.x, d.y, -x.y * d.x);
    const wide up = g * d.z, across = sx * d.x * ky - sy * d.y * kx;
    const wide moment = wide_fma(sx * sy * kz, kz, wide_fma(sy * sz * kx, kx, sx * sz * ky * ky));
    const wide discriminant = wide_fma(up, up, wide_fma(wide_all(R(2) * g), across, -moment - R(q->w) * a));
    /* The ends, the nearer one without cancellation, and how steep they are. */
    const wide root = wide_sqrt(wide_larger(discriminant, zero)), sum = -b - where(b < zero, -root, root);
    const wide_mask real_ends = discriminant > zero;
    const wide middle = -b * over, one = where(real_ends, c / sum, middle),
               other = where(real_ends, sum * over, middle);
    const wide lo = wide_smaller(one, other), hi = wide_larger(one, other);
    const wide_vec at_lo = wide_along(gradient, sd, lo), at_hi = wide_along(gradient, sd, hi);
    const real steep = norm * R(2) / (QUICK_SLOPE * QUICK_SLOPE);
    const wide rounded = norm * l->tolerance * l->tolerance * wide_larger(wide_fabs(a), wide_all(norm));
    const wide doubt_lo = wide_fma(wide_all(steep), wide_dot(at_lo, at_lo), rounded);
    const wide doubt_hi = wide_fma(wide_all(steep), wide_dot(at_hi, at_hi), rounded);
    const wide doubt = wide_smaller(doubt_lo, doubt_hi);
    const wide_mask none = ~flat & (discriminant < -wide_larger(doubt_lo, doubt_hi));
    const wide_mask near = flat | (~none & (discriminant < doubt)), hollow = a < zero;
    /* Of a line that is nearly flat, the farther end is as good as a, which has cancelled. */
    const wide_mask vague_lo = near | ~(discriminant > doubt_lo) | (flattish & (other < one));
    const wide_mask vague_hi = near | ~(discriminant > doubt_hi) | (flattish & (other > one));
    /* Of what is not met, all or nothing is inside. */
    const wide nowhere = where(hollow, wide_all(-INFINITE), wide_all(INFINITE));
    s->lo = s->lo_in = where(none, nowhere, lo);
    s->hi = s->hi_in = where(none, -nowhere, hi);
    s->keep = none | flat | ~hollow;
    if (any_lane(~none & (vague_lo | vague_hi))) {
        const wide off = R(16) * UNIT_ROUNDOFF * wide_fabs(middle * over) * dd;
        const wide out_lo = wide_sqrt(wide_larger(discriminant, zero) + doubt_lo) * wide_fabs(over);
        const wide out_hi = wide_sqrt(wide_larger(discriminant, zero) + doubt_hi) * wide_fabs(over);
        const wide_mask lower = ~none & vague_lo, upper = ~none & vague_hi;
        s->lo = where(lower, where(flat, wide_all(-INFINITE), middle - out_lo - off), s->lo);
        s->hi = where(upper, where(flat, wide_all(INFINITE), middle + out_hi + off), s->hi);
        s->lo_in = where(lower, where(near, wide_all(INFINITE), middle), s->lo_in);
        s->hi_in = where(upper, where(near, wide_all(-INFINITE), middle), s->hi_in);
    }
    const wide_mask left = wide_is(l->left, member);
    if (any_lane(left)) {
        const int convex = sx >= R(0) && sy >= R(0) && sz >= R(0);
        const wide_vec slope = packet_gradient(q, wide_apply(q->m, wide_less(l->origin, q->c)));
        const wide back = wide_dot(slope, d), steepness = QUICK_SLOPE * back;
        const wide_mask again = left & ~flat & ~((a > zero) ^ l->left_inside);
        const wide_mask gone = left & ~again & (convex ? ~(l->left_inside & flat) : ~flat);
        packet_left(l, gone, s);
        packet_chord(l, again, R(-2) * back * over, ~(steepness * steepness > norm * wide_dot(slope, slope)), s);
    }
}
#endif

/* A member of a group, whatever side of it is meant. */
INLINED PacketSpan packet_member(const World* world, u32 member, const PacketLine* l)
{
    const u32 index = member >> MEMBER_SHIFT, face = member & ~MEMBER_INVERSE;
    PacketSpan s = packet_span(-INFINITE, INFINITE);
    switch (member & MEMBER_KIND) {
#ifdef CLU_PLANE
    case MEMBER_PLANE: packet_plane(&world->planes[index], face, l, &s); break;
#endif
#ifdef CLU_SPHERE
    case MEMBER_SPHERE: packet_sphere(&world->spheres[index], face, l, &s); break;
#endif
#ifdef CLU_QUADRIC
    case MEMBER_QUADRIC: packet_quadric(&world->quadrics[index], face, l, &s); break;
#endif
    default: packet_vague(&s, all_ids(-1)); break; /* a torus has two intervals */
    }
    if (member & MEMBER_INVERSE) s.keep = ~s.keep;
    s.face_lo = s.face_hi = all_ids((int)member);
    return s;
}

#endif
