/// The writer: any scene as canonical text of clucida's own language, such that reading it back gives an equal scene.
#pragma once

#include "scene/model.h"

#include <string>

namespace clucida::scene {

std::string print_scene(const Scene& scene);

} // namespace clucida::scene
