/// A quadric given by its ten coefficients, brought to the normal form's frame.
#pragma once

#include "scene/normal_form.h"

#include <optional>
#include <variant>

namespace clucida::scene {

/// The same solid as a quadric in its own frame, or, if no term is of second degree, as a half-space. Nothing if the
/// solid has no boundary.
std::optional<std::variant<HalfSpace, Quadric>> canonical(const FreeQuadric& quadric);

} // namespace clucida::scene
