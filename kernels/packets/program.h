/* Objects of a boolean program, as solid.h has the others: the groups that hold a ray are bits, and the rays go from
 * one end to the next until the program says another thing. */
#ifndef CLUCIDA_PACKETS_PROGRAM_H
#define CLUCIDA_PACKETS_PROGRAM_H

#include "kernels/packets/group.h"

#ifdef CLU_PROGRAM
#define PROGRAM_GROUPS (CLU_GROUP_CAPACITY < 32 ? CLU_GROUP_CAPACITY : 32)
typedef struct {
    u32 count;
    PacketSpan groups[PROGRAM_GROUPS];
} PacketProgram;

/* What the program says where each group holds the lanes that it says; a stack of truths, its top at bit 0. */
INLINED wide_mask program_value(const World* world, __global const LayoutObject* object, const wide_mask* held)
{
    const wide_id one = all_ids(1);
    wide_id bits = all_ids(0);
    for (u32 i = 0; i < object->program_count; i++) {
        const u32 op = world->programs[object->program_begin + i], n = op >> OP_SHIFT;
        if ((op & OP_MASK) == OP_GROUP) {
            bits = (bits << 1) | (held[n] & one);
            continue;
        }
        const wide_id mask = all_ids((int)((2u << (n - 1)) - 1u)), top = bits & mask;
        const wide_mask value = (op & OP_MASK) == OP_AND ? top == mask : top != all_ids(0);
        bits = (n < 32 ? (bits >> (int)n) << 1 : all_ids(0)) | (value & one);
    }
    return (bits & one) != all_ids(0);
}

/* The groups' spans, or 0 if there are too many. */
INLINED int packet_program(const World* world, __global const LayoutObject* object, const PacketLine* l,
                           PacketProgram* program)
{
    program->count = object->group_count;
    if (program->count > PROGRAM_GROUPS) return 0;
    for (u32 i = 0; i < program->count; i++) packet_group(world, object, i, l, all_ids(-1), &program->groups[i]);
    return 1;
}

INLINED wide_mask program_at(const World* world, __global const LayoutObject* object, const PacketProgram* program,
                             wide at)
{
    wide_mask held[PROGRAM_GROUPS];
    for (u32 i = 0; i < program->count; i++) {
        const PacketSpan* s = &program->groups[i];
        held[i] = ~(((s->lo <= at) & (at < s->hi)) ^ s->keep);
    }
    return program_value(world, object, held);
}

/* Whether an end of a group's lies so near that it may be another place; where the ray has left it, it is known. */
INLINED wide_mask program_doubt(const PacketProgram* program, wide at, wide tolerance, wide known)
{
    wide_mask doubt = all_ids(0);
    for (u32 i = 0; i < program->count; i++) {
        const PacketSpan* s = &program->groups[i];
        const wide_mask near_lo = (wide_fabs(s->lo - at) <= tolerance) & ~(s->lo == known);
        const wide_mask near_hi = (wide_fabs(s->hi - at) <= tolerance) & ~(s->hi == known);
        const wide_mask within = (at >= s->lo) & (at <= s->hi);
        doubt |= near_lo | near_hi | (within & ((at < s->lo_in) | ((at >= s->hi_in) & vague_hi(s))));
    }
    return doubt;
}

static CALLED void packet_program_crossing(const World* world, __global const LayoutObject* object, const PacketLine* l,
                                           wide_mask open, wide_mask inside, PacketEnd* e)
{
    const wide from = l->start, infinite = wide_all(INFINITE);
    PacketProgram program;
    if (!packet_program(world, object, l, &program)) {
        packet_unsure(e, &open, open, from);
        return;
    }
    packet_unsure(e, &open, program_doubt(&program, from, l->tolerance, from), from);
    packet_unsure(e, &open, program_at(world, object, &program, from) ^ inside, from);
    wide at = from;
    for (u32 round = 0; round < 2u * program.count && any_lane(open); round++) {
        wide next = infinite, second = infinite;
        wide_id face = all_ids((int)MEMBER_NONE);
        wide_mask vague = all_ids(0);
        for (u32 i = 0; i < program.count; i++) {
            const PacketSpan* s = &program.groups[i];
            const wide_mask some = s->lo < s->hi;
            const wide lo = where(some & (s->lo > at), s->lo, infinite),
                       hi = where(some & (s->hi_in > at), s->hi_in, infinite);
            second = wide_smaller(second, wide_larger(next, lo));
            face = where_id(lo < next, s->face_lo, face);
            vague = where_id(lo < next, vague_lo(s), vague);
            next = wide_smaller(next, lo);
            second = wide_smaller(second, wide_larger(next, hi));
            face = where_id(hi < next, s->face_hi, face);
            vague = where_id(hi < next, vague_hi(s), vague);
            next = wide_smaller(next, hi);
        }
        open &= next < infinite;
        packet_unsure(e, &open, vague | ~(second > next + l->tolerance), next);
        at = where(open, next, at);
        const wide_mask crossed = open & (program_at(world, object, &program, at) ^ inside);
        e->t = where(crossed, at, e->t);
        e->face = where_id(crossed, face, e->face);
        e->sure |= crossed;
        e->met |= crossed;
        open &= ~crossed;
    }
}

static CALLED wide_mask packet_program_holds(const World* world, __global const LayoutObject* object,
                                             const PacketLine* l, wide at, wide_mask* want)
{
    PacketProgram program;
    if (!packet_program(world, object, l, &program)) {
        *want = all_ids(0);
        return *want;
    }
    *want &= ~program_doubt(&program, at, l->tolerance, wide_all(-INFINITE));
    return *want & program_at(world, object, &program, at);
}
#endif

#endif
