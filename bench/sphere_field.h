/// Scenes that differ in their number of objects only.
#pragma once

#include <string>

namespace clucida::bench {

/// The .clu text of so many spheres at random in a block, half of them glass, half opaque, under one light. They are
/// the smaller the more there are, so that they always cover about as much of the picture. The same number gives the
/// same text. It is bench/corpus.py's recipe.
std::string sphere_field(unsigned count);

} // namespace clucida::bench
