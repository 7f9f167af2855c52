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

/// Both hold the solid; infinite where it is unbounded or no bound was found. The box lies within the sphere's.
struct Bounds {
    BoundingSphere sphere;
    Box box;
};
Bounds bounds_of(const Form& form);

} // namespace clucida::scene
