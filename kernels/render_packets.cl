/* The entry point of CPUs with wide vectors: each work-item takes blocks of PACKET_TILE x PACKET_TILE pixels, one after
 * the other as it is done with the last, for one block often costs many times another, and implementations give each
 * thread a run of a launch's work-groups beforehand. */
#include "kernels/entry.h"
#include "kernels/packets/trace.h"

/* Samples sample_begin .. sample_end-1 of all pixels of a block, i0 and j0 from the tile's corner. */
INLINED void render_block(World* world, uint x0, uint y0, uint i0, uint j0, uint sample_begin, uint sample_end,
                          __global float4* restrict tile, size_t width)
{
    PixelBlock block;
    TileLight light;
    block.x = x0 + i0;
    block.y = y0 + j0;
    if (block.x >= world->frame->width || block.y >= world->frame->height) return;
    block.width = min(PACKET_TILE, world->frame->width - block.x);
    block.height = min(PACKET_TILE, world->frame->height - block.y);
    trace_block(world, &block, sample_begin, sample_end, &light);
    for (u32 j = 0; j < block.height; j++) {
        for (u32 i = 0; i < block.width; i++) {
            const size_t at = (j0 + j) * width + i0 + i;
            const real* sums = light.sums[j * PACKET_TILE + i];
            const float4 sum = sample_begin ? tile[at] : (float4)(0.0f);
            tile[at] = sum + (float4)((float)sums[0], (float)sums[1], (float)sums[2], 0.0f);
        }
    }
}

/* As kernels/render.cl has it, but that the tile has across x down blocks, of which the next that nobody has is counted
 * behind the statistics. */
__kernel void render(SCENE_PARAMETERS, const uint x0, const uint y0, const uint sample_begin, const uint sample_end,
                     __global float4* restrict tile, __global uint* restrict stats, const uint across, const uint down)
{
    World world = SCENE_WORLD;
    for (;;) {
        const uint number = atomic_inc(&stats[STAT_NEXT]);
        if (number >= across * down) break;
        render_block(&world, x0, y0, number % across * PACKET_TILE, number / across * PACKET_TILE, sample_begin,
                     sample_end, tile, (size_t)across * PACKET_TILE);
    }
    add_statistics(&world, stats, get_global_id(0));
}
