/// Solids into buffers: objects, groups, members, programs, primitives.
#pragma once

#include "kernels/layout.h"
#include "scene/compile.h"
#include "scene/linear.h"
#include "scene/tree.h"

namespace clucida::scene {

struct ObjectBuffers {
    std::vector<LayoutObject> objects;
    std::vector<FloatBox> boxes; ///< of the objects, relative to the eye
    std::vector<LayoutGroup> groups;
    std::vector<u32> members, programs;
    std::vector<LayoutPlane> planes;
    std::vector<LayoutPlaneBlock> blocks;
    std::vector<LayoutSphere> spheres;
    std::vector<LayoutQuadric> quadrics;
    std::vector<LayoutTorus> tori;
    std::size_t starts = 0; ///< objects that may hold the start of an observer's ray
    std::uint32_t features = 0;
    std::size_t most_groups = 1;
    std::size_t most_overlapping = 1; ///< no point lies in more objects
};

inline constexpr std::size_t most_members_of_object = 65536;
inline constexpr std::size_t most_groups_of_object = 1024;

/// Observer's rays start within start_radius of the eye.
ObjectBuffers compile_objects(const Scene& scene, Vec3 eye, double start_radius);

} // namespace clucida::scene
