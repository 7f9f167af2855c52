/// Kernel error: single intersections, the same ray into the kernels and the oracle.
#pragma once

#include "bench/faces.h"
#include "host/renderer.h"

#include <vector>

namespace clucida::bench {

/// Errors are distances of the points met, times the cosine of incidence, in units of u = 2^-24 times the size of the
/// numbers at hand: the largest of the coordinates of the ray's origin, of the point, and of what the object is made
/// of, relative to the eye or the object's centre as the buffers hold them.
struct KernelError {
    std::size_t rays = 0, wrong = 0; ///< wrong: another surface was met, or none
    double p50 = 0, p999 = 0, worst = 0;
};

/// Follows the rays of pixels on a grid, some steps each. settings.kernels are the kernels that are judged.
/// @throws host::Failure
KernelError measure_kernel_error(host::Renderer& renderer, const scene::Scene& scene, const scene::Compiled& compiled,
                                 const scene::Needs& needs, const host::RenderSettings& settings,
                                 const FaceNames& names, unsigned threads);

} // namespace clucida::bench
