/// Optics, textures, photographs, lights and sky into buffers.
#pragma once

#include "kernels/layout.h"
#include "scene/compile.h"
#include "scene/linear.h"
#include "scene/photograph.h"

namespace clucida::scene {

struct OpticsBuffers {
    std::vector<LayoutOptics> optics;
    std::vector<LayoutTexture> textures;
    std::vector<LayoutImage> images;
    std::vector<u32> texels;
    std::vector<LayoutLight> lights;
    std::uint32_t features = 0;
};

/// Sets the sky in frame too.
OpticsBuffers compile_optics(const Scene& scene, Vec3 eye, LayoutFrame& frame, PhotographCache& photographs);

} // namespace clucida::scene
