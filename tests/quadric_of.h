/// A quadric by its ten coefficients, made from a frame of its own.
#pragma once

#include "native_scene.h"

namespace clucida::test {

/// With X = m (p - c): where sum s X^2 + 2 sum l X + w < 0.
inline SolidPtr quadric_of(const scene::Mat3& m, Vec3 c, Vec3 s, Vec3 l, double w)
{
    using scene::component;
    Vec3 half; // of what is linear in p
    double rows[3][3] = {}, constant = w;
    for (int k = 0; k < 3; k++) {
        const double square = component(s, k), slope = component(l, k), at = scene::dot(m.rows[k], c);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) rows[i][j] += square * component(m.rows[k], i) * component(m.rows[k], j);
        half = half + m.rows[k] * (slope - square * at);
        constant += square * at * at - 2 * slope * at;
    }
    return solid(scene::FreeQuadric{{rows[0][0], rows[1][1], rows[2][2], 2 * rows[0][1], 2 * rows[0][2], 2 * rows[1][2],
                                     2 * half.x, 2 * half.y, 2 * half.z, constant}});
}

} // namespace clucida::test
