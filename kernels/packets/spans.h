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

/* The ends of a solid on the lines. */
typedef struct {
    wide lo, hi;
    wide_id face_lo, face_hi;
    wide_mask vague; /* the ends lie outwards of where they are */
    wide_mask keep;  /* inside is lo..hi; else inside is all but lo..hi */
} PacketSpan;

INLINED PacketSpan packet_span(real lo, real hi)
{
    PacketSpan s;
    s.lo = wide_all(lo);
    s.hi = wide_all(hi);
    s.face_lo = s.face_hi = all_ids((int)MEMBER_NONE);
    s.vague = all_ids(0);
    s.keep = all_ids(-1);
    return s;
}

/* Where rays have left the solid and meet it no more, or (chord) meet it again. */
INLINED void packet_left(const PacketLine* l, wide_mask left, PacketSpan* s)
{
    s->lo = where(left, where(l->left_inside, l->start, wide_all(-INFINITE)), s->lo);
    s->hi = where(left, where(l->left_inside, wide_all(INFINITE), l->start), s->hi);
    s->vague &= ~left;
    s->keep |= left;
}
INLINED void packet_chord(const PacketLine* l, wide_mask chord, wide length, wide_mask vague, PacketSpan* s)
{
    s->lo = where(chord, l->start, s->lo);
    s->hi = where(chord, l->start + length, s->hi);
    s->vague = where_id(chord, vague | ~(length > l->tolerance), s->vague);
    s->keep = where_id(chord, l->left_inside, s->keep);
}

#ifdef CLU_PLANE
/* Cuts the span down to what lies behind a plane. */
INLINED void packet_plane(__global const LayoutPlane* plane, u32 member, const PacketLine* l, PacketSpan* s)
{
    const wide zero = wide_all(R(0)), least = wide_all(R(1e-30f));
    wide nd = wide_dot_shared(plane->n, l->d);
    nd = where(wide_fabs(nd) < least, least, nd);
    wide_mask flat = wide_fabs(nd) < wide_all(R(1) / QUICK_SLOPE);
    const wide height = wide_dot_shared(plane->n, l->base) - wide_all(R(plane->h)) - where(flat, l->error, zero);
    const wide over = wide_all(R(1)) / nd, t = -height * over;
    const wide_mask enters = nd < zero, left = wide_is(l->left, member);
    wide lo = where(enters, t, wide_all(-INFINITE)), hi = where(enters, wide_all(INFINITE), t);
    if (any_lane(left)) {
        lo = where(left, where(l->left_inside, l->start, wide_all(-INFINITE)), lo);
        hi = where(left, where(l->left_inside, wide_all(INFINITE), l->start), hi);
        flat &= ~left;
    }
    const wide_mask later = lo > s->lo, sooner = hi < s->hi;
    const wide_id face = all_ids((int)member);
    s->lo = where(later, lo, s->lo);
    s->hi = where(sooner, hi, s->hi);
    s->face_lo = where_id(later, face, s->face_lo);
    s->face_hi = where_id(sooner, face, s->face_hi);
    if (any_lane(flat)) {
        const wide inwards = wide_fma(R(-2) * l->error, over, t);
        s->vague |= flat & ((enters & (inwards > s->lo)) | (~enters & (inwards < s->hi)));
    }
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
    s->vague = near & ~none;
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
    const wide_mask flat = ~(wide_fabs(a) > R(1e-3f) * wide_dot(d, d));
    const wide_vec x = wide_apply(q->m, wide_less(l->base, q->c)), gradient = packet_gradient(q, x);
    const wide b = wide_dot(gradient, d);
    const wide kx = wide_fma(x.y, d.z, -x.z * d.y), ky = wide_fma(x.z, d.x, -x.x * d.z),
               kz = wide_fma(x.x, d.y, -x.y * d.x);
    const wide up = g * d.z, across = sx * d.x * ky - sy * d.y * kx;
    const wide moment = wide_fma(sx * sy * kz, kz, wide_fma(sy * sz * kx, kx, sx * sz * ky * ky));
    const wide discriminant = wide_fma(up, up, wide_fma(wide_all(R(2) * g), across, -moment - R(q->w) * a));
    const wide middle = -b * over, some = wide_larger(discriminant, zero);
    const wide_vec halfway = wide_along(gradient, sd, middle);
    const wide steep = norm * wide_fma(wide_dot(sd, sd), some * over * over, wide_dot(halfway, halfway));
    const wide doubt = wide_fma(steep, wide_all(R(2) / (QUICK_SLOPE * QUICK_SLOPE)),
                                norm * l->tolerance * l->tolerance * wide_larger(wide_fabs(a), wide_all(norm)));
    const wide_mask none = discriminant < -doubt, near = discriminant < doubt, hollow = a < zero;
    const wide reach = wide_sqrt(some + where(near, doubt, zero)) * wide_fabs(over);
    /* Of what is not met, all or nothing is inside. */
    const wide nowhere = where(hollow, wide_all(-INFINITE), wide_all(INFINITE));
    s->lo = where(none, nowhere, middle - reach);
    s->hi = where(none, -nowhere, middle + reach);
    s->vague = near & ~none;
    s->keep = none | ~hollow;
    if (any_lane(flat)) {
        s->lo = where(flat, wide_all(-INFINITE), s->lo);
        s->hi = where(flat, wide_all(INFINITE), s->hi);
        s->vague |= flat;
        s->keep |= flat;
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
    default: s.vague = all_ids(-1); break; /* a torus has two intervals */
    }
    if (member & MEMBER_INVERSE) s.keep = ~s.keep;
    s.face_lo = s.face_hi = all_ids((int)member);
    return s;
}

#endif
