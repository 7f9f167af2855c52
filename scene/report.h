/// What `inspect` tells of a scene's objects.
#pragma once

#include "scene/compile.h"

#include <cstddef>
#include <string>
#include <vector>

namespace clucida::scene {

struct ObjectReport {
    std::string name;
    std::size_t planes = 0, spheres = 0, quadrics = 0, tori = 0, groups = 0, program = 0;
    double radius = 0; ///< of the bound; infinite if there is none
    std::size_t bytes = 0;
};

/// Of each object, in their order. buffers: what the scene was compiled to.
std::vector<ObjectReport> report_objects(const Scene& scene, const Buffers& buffers);

} // namespace clucida::scene
