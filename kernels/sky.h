/* The sky: a colour for every direction. */
#ifndef CLUCIDA_SKY_H
#define CLUCIDA_SKY_H

#include "kernels/texture.h"

#ifdef CLU_SKY_HSV
/* Hue in turns, 0..1. */
INLINED rgb from_hsv(real hue, real saturation, real value)
{
    const real h = hue * R(6) - R(6) * floor(hue);
    const real r = fmin(fmax(fabs(h - R(3)) - R(1), R(0)), R(1));
    const real g = fmin(fmax(R(2) - fabs(h - R(2)), R(0)), R(1));
    const real b = fmin(fmax(R(2) - fabs(h - R(4)), R(0)), R(1));
    return rgb_scale(rgb_mix(grey(R(1)), make_rgb(r, g, b), saturation), value);
}
#endif

INLINED rgb sky_color(const World* world, vec d)
{
    __global const LayoutFrame* f = world->frame;
    const u32 kind = f->sky;
#ifdef CLU_SKY_GRADIENT
    if (kind == SKY_GRADIENT) {
        const real height = dot3(load_vec(f->sky_axis), d);
        const rgb far = load_rgb(height < R(0) ? f->sky_low : f->sky_high);
        return rgb_mix(load_rgb(f->sky_middle), far, fmin(fabs(height), R(1)));
    }
#endif
#ifdef CLU_SKY_RGB
    if (kind == SKY_RGB) return make_rgb((d.x + R(1)) * R(0.5f), (d.y + R(1)) * R(0.5f), (R(1) - d.z) * R(0.5f));
#endif
#if defined(CLU_SKY_HSV) || defined(CLU_SKY_PHOTOGRAPH)
    real u, v;
    direction_to_uv(d, &u, &v);
#endif
#ifdef CLU_SKY_HSV
    if (kind == SKY_HSV) return from_hsv(u, fmin(R(1), R(2) * v), fmin(R(1), R(2) * (R(1) - v)));
#endif
#ifdef CLU_SKY_PHOTOGRAPH
    /* Seen from inside: mirrored, and u = 0 is the last column. */
    if (kind == SKY_PHOTOGRAPH) {
        const real width = R(world->images[f->sky_image].width);
        const real nearest = fmin(R(1) - u, (width - R(0.5f)) / width);
        const int smooth = (world->images[f->sky_image].flags & IMAGE_INTERPOLATE) != 0;
        const real last = R(1) - UNIT_ROUNDOFF * R(2);
        return photograph(world, f->sky_image, smooth ? R(1) - u : nearest, fmin(v, last), 0);
    }
#endif
    return load_rgb(f->sky_low);
}

#endif
