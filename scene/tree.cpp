#include "scene/tree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <future>
#include <limits>
#include <numeric>
#include <span>

namespace clucida::scene {
namespace {

constexpr std::size_t width = 8;
constexpr std::size_t most_upfront = 64; ///< children of roots that a walk begins with
constexpr std::size_t bins = 16;
constexpr float room_of_node = 32; ///< of a node: a surface so many times the root's over the number of boxes
constexpr std::size_t least_parallel = 20000; ///< boxes; below, a thread costs more than it gains

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr FloatBox nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

void enclose(FloatBox& box, const FloatBox& other)
{
    for (std::size_t axis = 0; axis < 3; axis++) {
        box.low[axis] = std::min(box.low[axis], other.low[axis]);
        box.high[axis] = std::max(box.high[axis], other.high[axis]);
    }
}

/// Half of its surface.
float area(const FloatBox& b)
{
    const float x = b.high[0] - b.low[0], y = b.high[1] - b.low[1], z = b.high[2] - b.low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}

float middle(const FloatBox& b, std::size_t axis)
{
    return 0.5F * b.low[axis] + 0.5F * b.high[axis];
}

/// A box to be placed, with its object.
struct Item {
    FloatBox box;
    u32 object;
};
using Items = std::span<Item>;

FloatBox around(Items items)
{
    FloatBox box = nothing;
    for (const Item& item : items) enclose(box, item.box);
    return box;
}

struct Split {
    std::size_t axis = 0;
    float at = 0; ///< middles below it go left
    float cost = infinity;
};

/// The cheapest of the planes between bins along one axis.
Split best_split(Items items, std::size_t axis, float low, float high)
{
    struct Bin {
        FloatBox box = nothing;
        std::size_t count = 0;
    };
    std::array<Bin, bins> all;
    const float scale = bins / (high - low);
    for (const Item& item : items) {
        const auto i = static_cast<std::size_t>(std::max(0.0F, (middle(item.box, axis) - low) * scale));
        Bin& bin = all[std::min(i, bins - 1)];
        enclose(bin.box, item.box);
        bin.count++;
    }
    std::array<float, bins> right{};
    FloatBox box = nothing;
    std::size_t count = 0;
    for (std::size_t i = bins; i-- > 1;) {
        enclose(box, all[i].box);
        count += all[i].count;
        right[i] = area(box) * static_cast<float>(count);
    }
    Split best{axis};
    box = nothing;
    count = 0;
    for (std::size_t i = 1; i < bins; i++) {
        enclose(box, all[i - 1].box);
        count += all[i - 1].count;
        const float cost = area(box) * static_cast<float>(count) + right[i];
        if (count > 0 && count < items.size() && cost < best.cost)
            best = {axis, low + static_cast<float>(i) / scale, cost};
    }
    return best;
}

/// Moves the items that go left to the front; returns how many.
std::size_t divide(Items items)
{
    std::array<float, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    for (const Item& item : items) {
        for (std::size_t axis = 0; axis < 3; axis++) {
            low[axis] = std::min(low[axis], middle(item.box, axis));
            high[axis] = std::max(high[axis], middle(item.box, axis));
        }
    }
    Split best;
    for (std::size_t axis = 0; axis < 3; axis++) {
        if (!(high[axis] > low[axis])) continue;
        const Split split = best_split(items, axis, low[axis], high[axis]);
        if (split.cost < best.cost) best = split;
    }
    const auto left = std::partition(items.begin(), items.end(),
                                     [&](const Item& item) { return middle(item.box, best.axis) < best.at; });
    const auto count = static_cast<std::size_t>(left - items.begin());
    return count > 0 && count < items.size() ? count : items.size() / 2; // all in one place, or rounding
}

/// A node of the tree of two children each, over `count` boxes: what is below its first child follows it, then what is
/// below the second, 2 count - 1 forks in all.
struct Fork {
    FloatBox box;
    u32 count = 1;
    u32 object = 0; ///< of the one box, where that is all
    /// What all nodes below cost if it becomes at most i + 1 children of a node above; and how many of these are its
    /// first child's, or 0 where it is cheapest as a node of its own.
    std::array<float, width> cost{};
    std::array<std::uint8_t, width> first{};
    std::uint8_t own_first = 1; ///< of its own node's children
};
using Forks = std::span<Fork>;

Forks first_of(Forks forks)
{
    return forks.subspan(1, 2 * std::size_t{forks[1].count} - 1);
}
Forks second_of(Forks forks)
{
    return forks.subspan(2 * std::size_t{forks[1].count});
}

/// Chooses what a fork becomes when that is known of its children (the optimal collapse of Ylitie, Karras, Laine 2017).
/// A node costs its surface, for so often it is met, and a little more for the room that it takes in the caches.
void weigh(Fork& fork, const Fork& a, const Fork& b, float room)
{
    for (std::size_t most = 2; most <= width; most++) {
        float& least = fork.cost[most - 1];
        for (std::size_t first = 1; first < most; first++) {
            const float cost = a.cost[first - 1] + b.cost[most - first - 1];
            if (first > 1 && !(cost < least)) continue;
            least = cost;
            fork.first[most - 1] = static_cast<std::uint8_t>(first);
        }
    }
    fork.own_first = fork.first[width - 1];
    fork.cost[0] = fork.cost[width - 1] + area(fork.box) + room;
    for (std::size_t i = 1; i < width; i++) {
        if (!(fork.cost[0] < fork.cost[i])) continue;
        fork.cost[i] = fork.cost[0];
        fork.first[i] = 0;
    }
}

void divide_all(Items items, Forks forks, float room)
{
    Fork& fork = forks[0];
    fork.count = static_cast<u32>(items.size());
    if (items.size() == 1) {
        fork.box = items[0].box;
        fork.object = items[0].object;
        return;
    }
    const std::size_t left = divide(items);
    const Forks a = forks.subspan(1, 2 * left - 1), b = forks.subspan(2 * left);
    std::future<void> pending;
    if (items.size() >= least_parallel)
        pending = std::async(std::launch::async, divide_all, items.first(left), a, room);
    else
        divide_all(items.first(left), a, room);
    divide_all(items.subspan(left), b, room);
    if (pending.valid()) pending.get();
    fork.box = a[0].box;
    enclose(fork.box, b[0].box);
    weigh(fork, a[0], b[0], room);
}

/// What becomes of a fork as at most so many children of a node.
void collect(Forks forks, std::size_t most, std::vector<Forks>& children)
{
    const std::size_t first = forks.size() == 1 ? 0 : forks[0].first[most - 1];
    if (first == 0) {
        children.push_back(forks);
        return;
    }
    collect(first_of(forks), first, children);
    collect(second_of(forks), most - first, children);
}

LayoutNode empty_node()
{
    LayoutNode node{};
    for (std::size_t axis = 0; axis < 3; axis++) {
        std::ranges::fill(node.bounds[axis], infinity);
        std::ranges::fill(node.bounds[axis + 3], -infinity);
    }
    return node;
}

void set_child(LayoutNode& node, std::size_t lane, const FloatBox& box, u32 child)
{
    for (std::size_t axis = 0; axis < 3; axis++) {
        node.bounds[axis][lane] = box.low[axis];
        node.bounds[axis + 3][lane] = box.high[axis];
    }
    node.child[lane] = child;
}

/// Nodes to reserve: a little more than spheres at random take (0.23 a box). Growing step by step holds twice as many.
std::size_t room_for(Items items)
{
    return items.size() / 4 + 1;
}

/// Fills a node; all below it goes to the end, what is below a child right after that. Returns how many nodes and
/// objects may wait in a walk that goes down into it, besides what waited before.
std::size_t fill_node(std::vector<LayoutNode>& nodes, std::size_t index, Forks forks)
{
    std::vector<Forks> children;
    if (forks.size() == 1) {
        children.push_back(forks);
    } else {
        collect(first_of(forks), forks[0].own_first, children);
        collect(second_of(forks), width - forks[0].own_first, children);
    }
    std::size_t deepest = 1;
    for (std::size_t lane = 0; lane < children.size(); lane++) {
        const Fork& child = children[lane][0];
        if (child.count == 1) {
            set_child(nodes[index], lane, child.box, child.object);
            continue;
        }
        const std::size_t below = nodes.size();
        set_child(nodes[index], lane, child.box, NODE_INNER | static_cast<u32>(below));
        nodes.push_back(empty_node());
        deepest = std::max(deepest, fill_node(nodes, below, children[lane]));
    }
    return children.size() - 1 + deepest;
}

/// Makes the first node the root over the items. Returns Tree's reserve.
std::size_t grow(std::vector<LayoutNode>& nodes, Items items)
{
    std::vector<Fork> forks(2 * items.size() - 1);
    divide_all(items, forks, room_of_node * area(around(items)) / static_cast<float>(items.size()));
    return std::max(fill_node(nodes, 0, forks), width) - width;
}

bool is_bounded(const FloatBox& b)
{
    for (std::size_t axis = 0; axis < 3; axis++)
        if (!std::isfinite(b.low[axis]) || !std::isfinite(b.high[axis])) return false;
    return true;
}

/// Nodes of eight neighbours each, none above them.
void list(Tree& tree, Items items)
{
    for (std::size_t i = 0; i < items.size(); i++) {
        if (i % width == 0) tree.nodes.push_back(empty_node());
        set_child(tree.nodes.back(), i % width, items[i].box, items[i].object);
    }
}

} // namespace

Tree build_tree(std::vector<FloatBox> boxes)
{
    std::vector<Item> bounded, endless;
    bounded.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); i++)
        (is_bounded(boxes[i]) ? bounded : endless).push_back({boxes[i], static_cast<u32>(i)});
    boxes = {};

    Tree tree;
    if (bounded.size() + endless.size() <= LIST_CAPACITY) {
        endless.insert(endless.end(), bounded.begin(), bounded.end());
        bounded.clear();
    }
    // The tree's root comes first of all: a walk that meets it first finds the nearest first.
    if (!bounded.empty()) tree.nodes.push_back(empty_node());
    list(tree, endless);
    tree.roots = tree.nodes.size();
    if (!bounded.empty()) {
        tree.nodes.reserve(tree.roots + room_for(bounded));
        tree.reserve = grow(tree.nodes, bounded);
    }
    tree.stack = std::min(width * tree.roots, most_upfront) + tree.reserve;
    return tree;
}

} // namespace clucida::scene
