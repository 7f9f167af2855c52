/* Photographs, and how they lie on a surface or on the sky. */
#ifndef CLUCIDA_TEXTURE_H
#define CLUCIDA_TEXTURE_H

#include "kernels/angle.h"
#include "kernels/color.h"
#include "kernels/world.h"

/* The unit square's point for a direction (X, Y, Z in the mapping's frame, Z to the pole): u around, from -Y; v from
 * the pole to its opposite. */
INLINED void direction_to_uv(vec d, real* u, real* v)
{
    real phi = angle_of(d.y, d.x);
    if (phi < R(-0.5f) * PI_REAL) phi += R(2) * PI_REAL;
    *u = (phi + R(0.5f) * PI_REAL) / (R(2) * PI_REAL);
    *v = angle_of(sqrt(d.x * d.x + d.y * d.y), d.z) / PI_REAL;
}

#if defined(CLU_TEXTURE) || defined(CLU_SKY_PHOTOGRAPH)
/* The first 256 texels are not texels but sRGB's decoding table, as floats. */
INLINED rgb decode_texel(const World* world, u32 texel, u32 flags)
{
    const u32 r = texel & 255u, g = texel >> 8 & 255u, b = texel >> 16 & 255u;
    if (flags & IMAGE_LINEAR) return make_rgb(R(r) / R(255), R(g) / R(255), R(b) / R(255));
    return make_rgb(R(as_float(world->texels[r])), R(as_float(world->texels[g])), R(as_float(world->texels[b])));
}

INLINED rgb texel_at(const World* world, const LayoutImage* image, int column, int row)
{
    return decode_texel(world, world->texels[image->offset + (u32)row * image->width + (u32)column], image->flags);
}

/* The photograph at (u, v) in 0..1, v downwards; columns wrap around, rows do where wrap_rows is set. */
INLINED rgb photograph(const World* world, u32 id, real u, real v, int wrap_rows)
{
    const LayoutImage image = world->images[id];
    const int width = (int)image.width, height = (int)image.height;
    real x = u * R(width), y = v * R(height);
    if (!(image.flags & IMAGE_INTERPOLATE)) {
        if (!(x >= R(0) && y >= R(0) && x < R(width) && y < R(height))) return grey(R(0));
        return texel_at(world, &image, (int)x, (int)y);
    }
    x = fmin(fmax(x, R(0)), R(width)) - R(0.5f);
    y = fmin(fmax(y, R(0)), R(height)) - R(0.5f);
    const real fx = floor(x), fy = floor(y);
    int c0 = (int)fx, r0 = (int)fy;
    int c1 = c0 + 1, r1 = r0 + 1;
    c0 = c0 < 0 ? width - 1 : c0;
    c1 = c1 >= width ? 0 : c1;
    r0 = r0 < 0 ? (wrap_rows ? height - 1 : 0) : r0;
    r1 = r1 >= height ? (wrap_rows ? 0 : height - 1) : r1;
    const rgb above = rgb_mix(texel_at(world, &image, c0, r0), texel_at(world, &image, c1, r0), x - fx);
    const rgb below = rgb_mix(texel_at(world, &image, c0, r1), texel_at(world, &image, c1, r1), x - fx);
    return rgb_mix(above, below, y - fy);
}
#endif

#ifdef CLU_TEXTURE
INLINED real wrapped(real x, real wrap)
{
    x += wrap;
    return x >= R(1) ? x - R(1) : x;
}

INLINED real fraction(real x)
{
    return x - floor(x);
}

/* The photograph's colour at surface point p (relative to the eye) with outward normal n. */
INLINED rgb texture_color(const World* world, const LayoutTexture* t, vec p, vec n)
{
    const vec d =
        t->mapping == MAPPING_DIRECTIONAL ? n : sub(p, make_vec(R(t->origin[0]), R(t->origin[1]), R(t->origin[2])));
    const vec x = make_vec(R(t->x[0]), R(t->x[1]), R(t->x[2]));
    const vec y = make_vec(R(t->y[0]), R(t->y[1]), R(t->y[2]));
    const vec z = make_vec(R(t->z[0]), R(t->z[1]), R(t->z[2]));
    const real scale = R(t->scale);
    const vec turned = make_vec(dot3(x, d), dot3(y, d), dot3(z, d));
    real u, v;
    int wrap_rows = 1;
    switch (t->mapping) {
    case MAPPING_POSITIONAL: {
        /* origin holds the eye's own phase: the surface's point is p + eye. */
        u = fraction(fma(dot3(x, p), scale, R(t->origin[0])));
        v = fraction(fma(dot3(y, p), scale, R(t->origin[1])));
        break;
    }
    case MAPPING_LINEAR:
        u = (angle_of(turned.y, turned.x) + PI_REAL) / (R(2) * PI_REAL);
        v = fraction(turned.z * scale);
        break;
    case MAPPING_PLANAR:
        u = fraction(turned.x);
        v = fraction(turned.y);
        break;
    default:
        direction_to_uv(turned, &u, &v);
        u = scale == R(1) ? u : fraction(u * scale);
        v = scale == R(1) ? v : fraction(v * scale);
        wrap_rows = scale != R(1);
        break;
    }
    return photograph(world, t->image, wrapped(u, R(t->wrap[0])), wrapped(v, R(t->wrap[1])), wrap_rows);
}
#endif

#endif
