/* The entry point `render` by packets: the kernels/render.cl of an experiment (README.md). Of every 32x32 pixels one
 * work-item traces all, the others nothing. */
#include "kernels/entry.h"
#include "kernels/shade.h"

static CALLED u32 scalar_medium_at_start(World* world, const Ray* ray)
{
    return medium_at_start(world, ray);
}

/* The bits of even places, side by side. */
INLINED u32 even_bits(u32 m)
{
    m &= 0x55555555u;
    m = (m | m >> 1) & 0x33333333u;
    m = (m | m >> 2) & 0x0f0f0f0fu;
    return (m | m >> 4) & 0x00ff00ffu;
}

/* The media that the packet's rays start in. */
INLINED void find_starts(World* world, Packet* packet)
{
    const vvec o = packet_vec(packet, ROW_OX);
    vint near = (vint)(0);
    for (u32 id = 0; id < world->frame->object_count; id++) {
        __global const LayoutObject* object = &world->objects[id];
        const vvec p = vless(o, object->center);
        near |= vdot(p, p) <= object->radius * object->radius * 1.0001f;
    }
    if (!any_lane(near)) return;
    World copy = *world;
    for (u32 i = 0; i < POOL_WIDTH; i++) {
        if (!has_ray(packet, i)) continue;
        const Ray ray = lane_ray(packet, i);
        const u32 medium = scalar_medium_at_start(&copy, &ray);
        packet->row[ROW_MEDIUM][i] = as_float(is_open(world, medium) ? as_medium(medium) : (u32)MEDIUM_NO_RAY);
    }
    take_counts(world, &copy);
}

/* The rays of a tile's pixels from a place in Morton's order on. */
INLINED void observe_packet(World* world, u32 x0, u32 y0, u32 x1, u32 y1, u32 place, u32 sample, Packet* packet)
{
    __global const LayoutFrame* f = world->frame;
#if POOL_WIDTH == 8
    const vint di = (vint)(0, 1, 0, 1, 2, 3, 2, 3), dj = (vint)(0, 0, 1, 1, 0, 0, 1, 1);
#else
    const vint di = (vint)(0, 1, 0, 1, 2, 3, 2, 3, 0, 1, 0, 1, 2, 3, 2, 3);
    const vint dj = (vint)(0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3);
#endif
    const vint i = di + (int)even_bits(place), j = dj + (int)even_bits(place >> 1);
    const vint x = i + (int)x0, y = j + (int)y0, within = (x < (vint)((int)x1)) & (y < (vint)((int)y1));
    real a, b;
    sample_offset(sample, f->corner, &a, &b);
    const vreal u = (TO_REALS(x) - 0.5f * (float)f->width + a) / (float)f->width;
    const vreal v = (TO_REALS(y) - 0.5f * (float)f->height + b) / (float)f->height;
    vvec s, d;
    s.x = f->column[0] * u + f->row[0] * v;
    s.y = f->column[1] * u + f->row[1] * v;
    s.z = f->column[2] * u + f->row[2] * v;
    d.x = f->forward[0] + s.x;
    d.y = f->forward[1] + s.y;
    d.z = f->forward[2] + s.z;
    d = vunit(d);
    put_vec(packet, ROW_OX, vscaled(s, ALL(f->window)));
    put_vec(packet, ROW_DX, d);
    STORE(vexcess(d), 0, packet->row[ROW_EXCESS]);
    STORE(ALL(0.0f), 0, packet->row[ROW_ERR]);
    STORE(AS_REALS((vword)(MEMBER_NONE)), 0, packet->row[ROW_LEFT]);
    STORE(ALL(0.0f), 0, packet->row[ROW_LEFT_INSIDE]);
    STORE(AS_REALS(CHOOSE(within, (vint)(MEDIUM_VACUUM), (vint)(MEDIUM_NO_RAY))), 0, packet->row[ROW_MEDIUM]);
    STORE(AS_REALS(AS_WORDS(j * (int)TILE + i) | f->max_hops << PIXEL_BITS), 0, packet->row[ROW_TAG]);
    for (u32 row = ROW_THROUGHPUT; row < ROW_COUNT; row++) STORE(ALL(1.0f), 0, packet->row[row]);
    if (f->start_count) find_starts(world, packet);
    for (u32 k = 0; k < POOL_WIDTH; k++)
        if (has_ray(packet, k)) COUNT(world, STAT_PRIMARY);
}

INLINED void trace_packet(World* world, Stacks* stacks, const Packet* packet, TileLight* light)
{
    const vint medium = AS_INTS(LOAD(0, packet->row[ROW_MEDIUM]));
    if (!any_lane(medium != (vint)(MEDIUM_NO_RAY))) return;
    const PacketHit hit =
        packet_search(world, packet_vec(packet, ROW_OX), packet_vec(packet, ROW_DX),
                      AS_WORDS(LOAD(0, packet->row[ROW_LEFT])), AS_INTS(LOAD(0, packet->row[ROW_LEFT_INSIDE])), medium);
    LaneHits hits;
    STORE(hit.t, 0, hits.t);
    STORE(hit.object, 0, hits.object);
    STORE(hit.face, 0, hits.face);
    STORE(hit.after, 0, hits.after);
    shade_packet(world, stacks, packet, &hits, light);
}

/* As kernels/render.cl has it. */
__kernel void render(SCENE_PARAMETERS, const uint x0, const uint y0, const uint sample_begin, const uint sample_end,
                     __global float4* restrict tile, __global uint* restrict stats)
{
    const u32 i0 = (u32)get_global_id(0), j0 = (u32)get_global_id(1);
    const u32 width = (u32)get_global_size(0), height = (u32)get_global_size(1);
    if (i0 % TILE || j0 % TILE) return;
    World world = SCENE_WORLD;
    const u32 x1 = min(frame->width, x0 + width), y1 = min(frame->height, y0 + height);
    Stacks stacks;
    TileLight light;
    for (u32 i = 0; i < STACKS; i++) stacks.count[i] = 0;
    for (u32 i = 0; i < TILE * TILE; i++) light.sums[i][0] = light.sums[i][1] = light.sums[i][2] = 0;
    u32 next = sample_begin * TILE * TILE;
    const u32 last = sample_end * TILE * TILE;
    for (;;) {
        Packet packet;
        u32 stack = full_stack(&stacks);
        if (stack == STACKS && next < last) {
            observe_packet(&world, x0 + i0, y0 + j0, x1, y1, next % (TILE * TILE), next / (TILE * TILE), &packet);
            next += POOL_WIDTH;
        } else {
            if (stack == STACKS) stack = fullest_stack(&stacks);
            if (stack == STACKS) break;
            pop_packet(&stacks, stack, &packet);
        }
        trace_packet(&world, &stacks, &packet, &light);
    }
    for (u32 j = 0; j < TILE && y0 + j0 + j < y1; j++) {
        for (u32 i = 0; i < TILE && x0 + i0 + i < x1; i++) {
            const size_t place = (size_t)(j0 + j) * width + i0 + i;
            const float4 sum = sample_begin ? tile[place] : (float4)(0.0f);
            tile[place] = sum + light_at(&light, j * TILE + i);
        }
    }
    add_statistics(&world, stats, (size_t)(j0 / TILE) * (width / TILE) + i0 / TILE);
}
