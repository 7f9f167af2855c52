// The tree over boxes: nothing lost, nothing twice, every child within its parent, and room enough for a walk.
#include "scene/tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace clucida::scene {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

FloatBox child_box(const LayoutNode& node, std::size_t lane)
{
    FloatBox box;
    for (std::size_t axis = 0; axis < 3; axis++) {
        box.low[axis] = node.bounds[axis][lane];
        box.high[axis] = node.bounds[axis + 3][lane];
    }
    return box;
}

bool is_empty(const FloatBox& b)
{
    return b.low[0] > b.high[0];
}

bool holds(const FloatBox& outer, const FloatBox& inner)
{
    for (std::size_t axis = 0; axis < 3; axis++)
        if (inner.low[axis] < outer.low[axis] || inner.high[axis] > outer.high[axis]) return false;
    return true;
}

struct Census {
    std::vector<unsigned> seen; ///< how often each object is a child
    std::size_t waiting = 0;    ///< the most that lies on a walk's stack when every box is met
};

/// Follows the walk of kernels/tree.h: all children of a node go onto the stack, the last of them comes off first.
void descend(const Tree& tree, u32 index, const FloatBox& bound, std::size_t below, Census& census)
{
    ASSERT_LT(index, tree.nodes.size());
    const LayoutNode& node = tree.nodes[index];
    std::size_t children = 0;
    for (std::size_t lane = 0; lane < 8; lane++) children += !is_empty(child_box(node, lane));
    census.waiting = std::max(census.waiting, below + children);
    std::size_t after = below + children;
    for (std::size_t lane = 0; lane < 8; lane++) {
        const FloatBox box = child_box(node, lane);
        if (is_empty(box)) continue;
        after--;
        ASSERT_TRUE(holds(bound, box)) << "node " << index << ", child " << lane;
        if ((node.child[lane] & NODE_INNER) != 0)
            descend(tree, node.child[lane] & ~NODE_INNER, box, after, census);
        else
            census.seen.at(node.child[lane])++;
    }
}

void expect_sound(const std::vector<FloatBox>& boxes)
{
    const FloatBox everything{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    const Tree tree = build_tree(boxes);
    Census census{std::vector<unsigned>(boxes.size()), 0};
    for (u32 root = 0; root < tree.roots; root++) descend(tree, root, everything, 0, census);
    for (std::size_t i = 0; i < boxes.size(); i++) ASSERT_EQ(census.seen[i], 1U) << "object " << i;
    EXPECT_LE(census.waiting, 8 + tree.reserve);
    EXPECT_GE(tree.stack, 8 * std::min<std::size_t>(tree.roots, 1) + tree.reserve);
}

std::vector<FloatBox> random_boxes(std::size_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-100, 100), size(0, 5);
    std::vector<FloatBox> boxes;
    for (std::size_t i = 0; i < count; i++) {
        FloatBox box;
        for (std::size_t axis = 0; axis < 3; axis++) {
            box.low[axis] = place(random);
            box.high[axis] = box.low[axis] + size(random);
        }
        boxes.push_back(box);
    }
    return boxes;
}

TEST(Tree, HoldsEveryBoxOnce)
{
    for (const std::size_t count :
         {0U, 1U, 7U, 8U, 9U, 40U, LIST_CAPACITY, LIST_CAPACITY + 1U, 100U, 1000U, 30000U, 200000U})
        expect_sound(random_boxes(count, static_cast<unsigned>(count)));
}

TEST(Tree, HoldsBoxesWithoutEndAndBoxesInOnePlace)
{
    std::vector<FloatBox> boxes = random_boxes(100, 1);
    boxes[3].high[1] = infinity;
    boxes[20].low = {-infinity, -infinity, -infinity};
    expect_sound(boxes);
    expect_sound(std::vector<FloatBox>(300, boxes[0]));
    for (FloatBox& box : boxes) box.high = {infinity, infinity, infinity};
    expect_sound(boxes);
}

TEST(Tree, HoldsBoxesWhoseSurfaceIsBeyondAllNumbers)
{
    std::vector<FloatBox> boxes = random_boxes(200, 3);
    for (FloatBox& box : boxes)
        for (auto* bounds : {&box.low, &box.high})
            for (float& x : *bounds) x *= 1e30F;
    expect_sound(boxes);
}

TEST(Tree, HasFewerNodesThanAQuarterOfTheBoxes)
{
    for (const std::size_t count : {100U, 1000U, 30000U})
        EXPECT_LT(build_tree(random_boxes(count, 4)).nodes.size(), count / 4);
}

TEST(Tree, IsDividedWhereThatPays)
{
    // Two clouds far apart: no child of the root spans the gap.
    std::vector<FloatBox> boxes = random_boxes(2 * LIST_CAPACITY, 2);
    for (std::size_t i = 0; i < LIST_CAPACITY; i++)
        for (auto* bounds : {&boxes[i].low, &boxes[i].high}) (*bounds)[0] += 10000;
    const Tree tree = build_tree(boxes);
    ASSERT_EQ(tree.roots, 1U);
    for (std::size_t lane = 0; lane < 8; lane++) {
        const FloatBox box = child_box(tree.nodes[0], lane);
        EXPECT_TRUE(is_empty(box) || box.high[0] - box.low[0] < 1000) << lane;
    }
}

} // namespace
} // namespace clucida::scene
