/* The entry point of CPUs with wide vectors: one work-item per block of PACKET_TILE x PACKET_TILE pixels of a tile. */
#include "kernels/entry.h"
#include "kernels/packets/trace.h"

INLINED uint greatest_common_divisor(uint a, uint b)
{
    while (b) {
        const uint rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* The i-th of count things in an order in which any run of them lies all over: PoCL gives each thread a run of a
 * launch's work-groups, and one side of a picture often costs more than another. Steps of the golden section are spread
 * evenly (Knuth, The Art of Computer Programming 3, 6.4). */
INLINED uint spread(uint i, uint count)
{
    uint step = max((uint)((float)count * 0.618034f), 1u);
    while (greatest_common_divisor(step, count) != 1u) step++;
    return (uint)((ulong)i * step % count);
}

/* As kernels/render.cl has it, but that the range is of blocks, and the tile as wide as they are together. */
__kernel void render(SCENE_PARAMETERS, const uint x0, const uint y0, const uint sample_begin, const uint sample_end,
                     __global float4* restrict tile, __global uint* restrict stats)
{
    const uint across = (uint)get_global_size(0), place = (uint)get_global_id(1) * across + (uint)get_global_id(0);
    const uint number = spread(place, across * (uint)get_global_size(1));
    const uint i0 = number % across * PACKET_TILE, j0 = number / across * PACKET_TILE;
    const size_t width = (size_t)across * PACKET_TILE;
    if (x0 + i0 >= frame->width || y0 + j0 >= frame->height) return;
    World world = SCENE_WORLD;
    PixelBlock block;
    TileLight light;
    block.x = x0 + i0;
    block.y = y0 + j0;
    block.width = min(PACKET_TILE, frame->width - block.x);
    block.height = min(PACKET_TILE, frame->height - block.y);
    trace_block(&world, &block, sample_begin, sample_end, &light);
    for (u32 j = 0; j < block.height; j++) {
        for (u32 i = 0; i < block.width; i++) {
            const size_t at = (j0 + j) * width + i0 + i;
            const real* sums = light.sums[j * PACKET_TILE + i];
            const float4 sum = sample_begin ? tile[at] : (float4)(0.0f);
            tile[at] = sum + (float4)((float)sums[0], (float)sums[1], (float)sums[2], 0.0f);
        }
    }
    add_statistics(&world, stats, number);
}
