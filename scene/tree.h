/// The tree over the objects' boxes: what a ray surely misses is found out for eight children at a time.
#pragma once

#include "kernels/layout.h"

#include <array>
#include <cstddef>
#include <vector>

namespace clucida::scene {

/// Axis-aligned; may be infinite, or empty where some low > high.
struct FloatBox {
    std::array<float, 3> low, high;
};

struct Tree {
    std::vector<LayoutNode> nodes; ///< the roots first
    std::size_t roots = 0;
    std::size_t reserve = 0; ///< what the deepest branch leaves waiting on a walk's stack, a root's own children apart
    std::size_t stack = 0;   ///< room that a walk needs
};

/// Every box is a child of exactly one node. Few boxes lie in a list of nodes, all of them roots; more in a tree by the
/// surface-area heuristic (Goldsmith, Salmon 1987), built in parallel. Boxes without end are roots' children.
Tree build_tree(std::vector<FloatBox> boxes);

} // namespace clucida::scene
