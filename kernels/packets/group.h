/* What a group of solids holds of a packet's lines, and crossings that are found there: as kernels/quick.h. */
#ifndef CLUCIDA_PACKETS_GROUP_H
#define CLUCIDA_PACKETS_GROUP_H

#include "kernels/packets/spans.h"

/* What both spans, that keep, hold; in the lanes of `in`. */
INLINED void packet_cut(PacketSpan* s, wide_mask in, const PacketSpan* by)
{
    const wide_mask later = in & (by->lo > s->lo), sooner = in & (by->hi < s->hi);
    s->lo = where(later, by->lo, s->lo);
    s->hi = where(sooner, by->hi, s->hi);
    s->face_lo = where_id(later, by->face_lo, s->face_lo);
    s->face_hi = where_id(sooner, by->face_hi, s->face_hi);
    s->lo_in = where(in, wide_larger(by->lo_in, s->lo_in), s->lo_in);
    s->hi_in = where(in, wide_smaller(by->hi_in, s->hi_in), s->hi_in);
}

/* Whether an end is vague. */
INLINED wide_mask vague_lo(const PacketSpan* s)
{
    return s->lo_in > s->lo;
}
INLINED wide_mask vague_hi(const PacketSpan* s)
{
    return s->hi_in < s->hi;
}

/* Inside out. One that then starts or ends nowhere keeps one side of an end. */
INLINED void packet_complement(PacketSpan* s)
{
    const wide infinite = wide_all(INFINITE);
    s->keep = ~s->keep;
    const wide_mask begins = s->lo > -infinite, ends = s->hi < infinite, one_sided = ~s->keep & ~(begins & ends);
    if (!any_lane(one_sided)) return;
    const wide_mask before = one_sided & begins, after = one_sided & ends;
    const wide_mask all = one_sided & ~begins & ~ends, maybe = all & vague_lo(s);
    const wide lo = s->lo, hi = s->hi, lo_in = s->lo_in, hi_in = s->hi_in;
    const wide_id face_lo = s->face_lo;
    /* What was all of the line is nothing; what was perhaps all is perhaps nothing. */
    s->lo = where(after, hi_in, where(before, -infinite, where(all & ~maybe, infinite, lo)));
    s->hi = where(before, lo_in, where(after, infinite, where(all & ~maybe, -infinite, hi)));
    s->lo_in = where(after, hi, where(before, -infinite, where(all, infinite, lo_in)));
    s->hi_in = where(before, lo, where(after, infinite, where(all, -infinite, hi_in)));
    s->face_lo = where_id(after, s->face_hi, face_lo);
    s->face_hi = where_id(before, face_lo, s->face_hi);
    s->keep |= one_sided;
}

/* The span of an object's group, for the rays of `want`; where it does not keep it has two ends. */
static CALLED void packet_group(const World* world, __global const LayoutObject* object, u32 number,
                                const PacketLine* l, wide_mask want, PacketSpan* s)
{
    const u32 sole = object->sole;
    LayoutGroup group = {0, 1, 1, 0, 0, 0}; /* of a sole member */
    if (sole == MEMBER_NONE) group = world->groups[object->group_begin + number];
    *s = packet_span(-INFINITE, INFINITE);
    for (u32 i = 0; i < group.count; i++) {
        const u32 member = sole == MEMBER_NONE ? world->members[group.begin + i] : sole;
#ifdef CLU_PLANE
        if ((member & MEMBER_KIND) == MEMBER_PLANE && group.count > 1u) {
            const u32 next = i + 1u < group.count ? world->members[group.begin + i + 1u] : MEMBER_NONE;
            if ((next & MEMBER_KIND) == MEMBER_PLANE &&
                are_opposite(&world->planes[member >> MEMBER_SHIFT], &world->planes[next >> MEMBER_SHIFT])) {
                packet_slab(world, member, next, l, s);
                i++;
            } else {
                packet_plane(&world->planes[member >> MEMBER_SHIFT], member, l, s);
            }
            if (!any_lane(want & ~(s->lo > s->hi + l->tolerance))) break;
            continue;
        }
#endif
        const PacketSpan m = packet_member(world, member, l);
        if (group.count == 1u)
            *s = m;
        else
            packet_cut(s, all_ids(-1), &m);
    }
    const wide_mask thin = wide_fabs(s->hi - s->lo) < l->tolerance;
    if (any_lane(thin)) {
        s->lo = where(thin, s->lo - l->tolerance, s->lo);
        s->hi = where(thin, s->hi + l->tolerance, s->hi);
        s->lo_in = where(thin, wide_all(INFINITE), s->lo_in);
        s->hi_in = where(thin, wide_all(-INFINITE), s->hi_in);
    }
    if (group.inverse) {
        packet_complement(s);
        s->face_lo ^= all_ids((int)MEMBER_INVERSE);
        s->face_hi ^= all_ids((int)MEMBER_INVERSE);
    }
}

/* Crossings, right to within the line's tolerance where they are sure; where not, t is where doubt begins. */
typedef struct {
    wide t;
    wide_id face;
    wide_mask met, sure;
} PacketEnd;

/* Of the lanes in *open those that are in doubt from t on: they are met, and not looked at any more. */
INLINED void packet_unsure(PacketEnd* e, wide_mask* open, wide_mask which, wide t)
{
    which &= *open;
    e->t = where(which, t, e->t);
    e->sure &= ~which;
    e->met |= which;
    *open &= ~which;
}

INLINED PacketEnd packet_no_end(void)
{
    PacketEnd e;
    e.t = wide_all(INFINITE);
    e.face = all_ids((int)MEMBER_NONE);
    e.met = e.sure = all_ids(0);
    return e;
}

#endif
