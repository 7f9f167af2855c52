/// A quadric given by its ten coefficients, brought to the normal form's frame.
#pragma once

#include "scene/normal_form.h"

#include <optional>
#include <variant>

namespace clucida::scene {

/// Two planes: where exactly one of the half-spaces holds if they cross; else where both do, or not both.
struct PlanePair {
    HalfSpace a, b;
    bool crossing = false, inverse = false;
};

/// The same solid as a quadric in its own frame, or as the planes that it is made of: in halves their distance
/// is sharp even near the edge where they cross. Nothing if the solid has no boundary.
std::optional<std::variant<HalfSpace, PlanePair, Quadric>> canonical(const FreeQuadric& quadric);

} // namespace clucida::scene
