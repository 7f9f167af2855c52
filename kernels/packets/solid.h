/* Where a packet's rays cross the boundary of one object: as kernels/quick.h has it of one ray. */
#ifndef CLUCIDA_PACKETS_SOLID_H
#define CLUCIDA_PACKETS_SOLID_H

#include "kernels/packets/program.h"

/* What an object holds of the lines, or does not: one interval less some. */
#define PACKET_GAPS (CLU_GROUP_CAPACITY < 8 ? CLU_GROUP_CAPACITY : 8)
typedef struct {
    PacketSpan whole;
    u32 gap_count;
    PacketSpan gaps[PACKET_GAPS];
} PacketSolid;

/* Where the solid is entered from the rays' start on, which it does not hold. */
INLINED void packet_entry(const PacketSolid* solid, const PacketLine* l, wide_mask open, PacketEnd* e)
{
    const PacketSpan* whole = &solid->whole;
    const wide from = l->start, tolerance = l->tolerance, before = from - tolerance, after = from + tolerance;
    const wide_mask left = (whole->hi == from) & ((whole->face_hi & all_ids(~(int)MEMBER_INVERSE)) == l->left);
    open &= ~((whole->hi < before) | left | ((whole->hi < after) & (whole->lo < before)));
    if (!any_lane(open)) return;
    const wide_mask within = ~(whole->lo > after);
    packet_unsure(e, &open,
                  where_id(within, whole->lo_in > before, vague_lo(whole)) |
                      (whole->hi_in < wide_larger(whole->lo, from) + tolerance),
                  wide_larger(wide_smaller(whole->lo, whole->hi) - tolerance, from));
    /* Within the whole the ray must begin in a gap. */
    wide t = where(within, from, whole->lo);
    wide_id face = whole->face_lo;
    if (solid->gap_count) {
        wide_mask in_gap = ~within, ends = all_ids(0);
        wide_id last = all_ids(-1);
        if (any_lane(open & within))
            for (u32 i = 0; i < solid->gap_count; i++)
                ends |= (solid->gaps[i].hi >= before) & (solid->gaps[i].hi <= after);
        /* A gap ends in another at most as often as there are gaps. */
        wide_mask moved = open;
        for (u32 round = 0; round <= solid->gap_count && any_lane(moved); round++) {
            moved = all_ids(0);
            for (u32 i = 0; i < solid->gap_count; i++) {
                const PacketSpan* g = &solid->gaps[i];
                const wide_mask meets = open & ~(g->lo > t + tolerance) & ~(g->hi < t - tolerance) & ~wide_is(last, i);
                if (!any_lane(meets)) continue;
                const wide_mask own = (g->lo == from) & ((g->face_lo & all_ids(~(int)MEMBER_INVERSE)) == l->left);
                const wide_mask here = (t == from) & (~ends | own);
                packet_unsure(
                    e, &open,
                    meets & (vague_lo(g) | vague_hi(g) | (g->hi < t + tolerance) | ((g->lo > t - tolerance) & ~here)),
                    t);
                const wide_mask passes = meets & open;
                t = where(passes, g->hi, t);
                face = where_id(passes, g->face_hi, face);
                last = where_id(passes, all_ids((int)i), last);
                in_gap |= passes;
                moved |= passes;
            }
        }
        packet_unsure(e, &open, moved | ~in_gap, where(in_gap, t, from));
    } else {
        packet_unsure(e, &open, within, from);
    }
    open &= ~(t > whole->hi + tolerance);
    packet_unsure(e, &open, ~(t < whole->hi_in - tolerance), wide_smaller(t, whole->hi_in - tolerance));
    e->t = where(open, t, e->t);
    e->face = where_id(open, face, e->face);
    e->sure |= open;
    e->met |= open;
}

/* Where the solid is left, which holds the rays' start. */
INLINED void packet_exit(const PacketSolid* solid, const PacketLine* l, wide_mask open, PacketEnd* e)
{
    const PacketSpan* whole = &solid->whole;
    const wide from = l->start, before = from - l->tolerance, after = from + l->tolerance;
    packet_unsure(e, &open, (whole->lo > after) | ~(whole->hi > after), from);
    wide t = whole->hi, second = where(vague_hi(whole), whole->hi_in, wide_all(INFINITE));
    wide_id face = whole->face_hi;
    for (u32 i = 0; i < solid->gap_count; i++) {
        const PacketSpan* g = &solid->gaps[i];
        const wide_mask behind = (g->hi < after) & (g->lo < before), vague = vague_lo(g) | vague_hi(g);
        packet_unsure(e, &open, ~behind & (g->lo < after), from);
        const wide_mask ahead = open & ~behind, nearer = ahead & ~vague & (g->lo < t);
        second = where(ahead, wide_smaller(second, where(nearer, t, g->lo)), second);
        t = where(nearer, g->lo, t);
        face = where_id(nearer, g->face_lo, face);
    }
    open &= (t < wide_all(INFINITE)) | (second < wide_all(INFINITE));
    packet_unsure(e, &open, ~(second > t + l->tolerance), wide_smaller(t, second));
    e->t = where(open, t, e->t);
    e->face = where_id(open, face, e->face);
    e->sure |= open;
    e->met |= open;
}

/* Where the rays of `want` cross the object's boundary; inside: which start inside. Their line must be set. */
INLINED PacketEnd packet_crossing(const World* world, __global const LayoutObject* object, const PacketLine* l,
                                  wide_mask want, wide_mask inside)
{
    PacketEnd e = packet_no_end();
#ifdef CLU_PROGRAM
    if (object->form == FORM_PROGRAM) {
        packet_program_crossing(world, object, l, want, inside, &e);
        e.t = e.t - l->start;
        return e;
    }
#endif
    const int any = object->form == FORM_ANY;
    PacketSolid solid;
    solid.whole = packet_span(-INFINITE, INFINITE);
    solid.gap_count = 0;
    for (u32 i = 0; i < object->group_count; i++) {
        PacketSpan s;
        packet_group(world, object, i, l, want, &s);
        if (any) packet_complement(&s);
        packet_cut(&solid.whole, s.keep, &s);
        const wide_mask gap = ~s.keep & (s.lo < s.hi);
        if (any_lane(want & gap)) {
            if (solid.gap_count == PACKET_GAPS) {
                packet_unsure(&e, &want, gap, l->start);
            } else {
                s.lo = where(gap, s.lo, wide_all(INFINITE));
                s.hi = where(gap, s.hi, wide_all(-INFINITE));
                s.lo_in = where(gap, s.lo_in, wide_all(INFINITE));
                s.hi_in = where(gap, s.hi_in, wide_all(-INFINITE));
                solid.gaps[solid.gap_count++] = s;
            }
        }
    }
    /* Where the complement of a union is left, the union is entered. */
    const wide_mask entering = any ? inside : ~inside;
    const wide_mask missed =
        entering & ((solid.whole.lo > solid.whole.hi + l->tolerance) | (solid.whole.hi < l->start - l->tolerance));
    const wide_mask enter = want & entering & ~missed, exit = want & ~entering;
    if (any_lane(enter)) packet_entry(&solid, l, enter, &e);
    if (any_lane(exit)) packet_exit(&solid, l, exit, &e);
    e.t = e.t - l->start;
    return e;
}

/* An end of a group's so near a point that the quick search cannot tell on which side of it the point lies. */
typedef struct {
    wide_mask some;  /* the lanes of which that decides whether the object holds the point */
    wide_id face;    /* the end's */
    wide_mask opens; /* the object is entered there, not left */
} PacketDoubt;

/* Of the lanes of *want those whose points at parameter `at` of the line lie inside the object; taken from *want are
 * those for which that is not sure, or depends on one end alone. */
INLINED wide_mask packet_holds(const World* world, __global const LayoutObject* object, const PacketLine* l, wide at,
                               wide_mask* want, PacketDoubt* doubt)
{
    doubt->some = doubt->opens = all_ids(0);
    doubt->face = all_ids((int)MEMBER_NONE);
#ifdef CLU_PROGRAM
    if (object->form == FORM_PROGRAM) return packet_program_holds(world, object, l, at, want);
#endif
    const int any = object->form == FORM_ANY;
    wide_mask undecided = *want, decided = all_ids(0), doubtful = all_ids(0);
    for (u32 i = 0; i < object->group_count && any_lane(undecided); i++) {
        PacketSpan s;
        packet_group(world, object, i, l, undecided, &s);
        const wide tolerance = l->tolerance;
        const wide_mask at_lo = (at >= s.lo - tolerance) & (at <= wide_smaller(s.lo_in, s.hi) + tolerance);
        const wide_mask at_hi = (at <= s.hi + tolerance) & (at >= wide_larger(s.hi_in, s.lo) - tolerance);
        const wide_mask near = undecided & (at_lo | at_hi);
        if (any_lane(near)) {
            const wide_mask one_end = near & (at_lo ^ at_hi) & ~doubtful & ~vague_lo(&s) & ~vague_hi(&s);
            doubt->face = where_id(one_end, where_id(at_lo, s.face_lo, s.face_hi), doubt->face);
            doubt->opens = where_id(one_end, ~(at_lo ^ s.keep), doubt->opens);
            doubt->some = (doubt->some | one_end) & ~(near & ~one_end);
            doubtful |= near;
        }
        const wide_mask in = ~(((s.lo < at) & (at < s.hi)) ^ s.keep), done = undecided & ~near & (any ? in : ~in);
        decided |= done;
        undecided &= ~done;
    }
    doubtful &= ~decided;
    doubt->some &= doubtful;
    *want &= ~doubtful;
    return *want & (any ? decided : ~decided);
}

#endif
