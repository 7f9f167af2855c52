/// Bounds of solids in normal form.
#pragma once

#include "scene/normal_form.h"

#include <limits>

namespace clucida::scene {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Axis-aligned; may be infinite, or empty where some low > high.
struct Box {
    Vec3 low{-unbounded, -unbounded, -unbounded}, high{unbounded, unbounded, unbounded};
};

struct BoundingSphere {
    Vec3 center;
    double radius = unbounded;
};

/// A sphere that holds the solid; radius is infinite if the solid is unbounded or no bound was found.
BoundingSphere bounding_sphere(const Form& form);

} // namespace clucida::scene
