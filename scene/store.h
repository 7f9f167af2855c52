/// Doubles into the buffers' floats.
#pragma once

#include "scene/linear.h"

namespace clucida::scene {

inline void store(float* to, Vec3 v)
{
    to[0] = static_cast<float>(v.x);
    to[1] = static_cast<float>(v.y);
    to[2] = static_cast<float>(v.z);
}

inline void store(float* to, Rgb c)
{
    store(to, Vec3{c.r, c.g, c.b});
}

/// What float keeps of v.
inline Vec3 rounded(Vec3 v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

} // namespace clucida::scene
