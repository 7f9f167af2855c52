#include "scene/tree.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <numeric>
#include <span>

namespace clucida::scene {
namespace {

constexpr std::size_t width = 8;
constexpr std::size_t most_upfront = 64; ///< children of roots that a walk begins with
constexpr std::size_t bins = 16;
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

/// Up to eight parts: the one with the largest surface is divided again and again.
std::vector<Items> parts_of(Items items)
{
    struct Part {
        Items items;
        float size; ///< surface; 0 of what cannot be divided
    };
    std::vector<Part> parts{{items, 1}};
    while (parts.size() < width) {
        const auto largest =
            std::ranges::max_element(parts, {}, [](const Part& p) { return p.items.size() > 1 ? p.size : -1; });
        if (largest->items.size() < 2) break;
        const std::size_t left = divide(largest->items);
        const Items a = largest->items.first(left), b = largest->items.subspan(left);
        *largest = {a, area(around(a))};
        parts.push_back({b, area(around(b))});
    }
    std::vector<Items> out;
    out.reserve(parts.size());
    for (const Part& part : parts) out.push_back(part.items);
    return out;
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

/// A subtree whose first node is its root; inner references count from its own first node.
struct Subtree {
    std::vector<LayoutNode> nodes;
    std::size_t depth = 1; ///< nodes on the longest way down
};

Subtree build(Items items);

void append(Subtree& to, std::size_t lane, const FloatBox& box, Subtree child)
{
    const auto offset = static_cast<u32>(to.nodes.size());
    set_child(to.nodes[0], lane, box, NODE_INNER | offset);
    for (LayoutNode& node : child.nodes) {
        for (u32& c : node.child)
            if ((c & NODE_INNER) != 0) c += offset;
        to.nodes.push_back(node);
    }
    to.depth = std::max(to.depth, child.depth + 1);
}

Subtree build(Items items)
{
    Subtree tree;
    tree.nodes.push_back(empty_node());
    const std::vector<Items> parts = parts_of(items);
    std::vector<std::future<Subtree>> pending(parts.size());
    for (std::size_t lane = 0; lane < parts.size(); lane++)
        if (parts[lane].size() >= least_parallel) pending[lane] = std::async(std::launch::async, build, parts[lane]);
    for (std::size_t lane = 0; lane < parts.size(); lane++) {
        const Items part = parts[lane];
        if (part.size() == 1)
            set_child(tree.nodes[0], lane, part[0].box, part[0].object);
        else
            append(tree, lane, around(part), pending[lane].valid() ? pending[lane].get() : build(part));
    }
    return tree;
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

Tree build_tree(const std::vector<FloatBox>& boxes)
{
    std::vector<Item> bounded, endless;
    for (std::size_t i = 0; i < boxes.size(); i++)
        (is_bounded(boxes[i]) ? bounded : endless).push_back({boxes[i], static_cast<u32>(i)});

    Tree tree;
    if (bounded.size() + endless.size() <= LIST_CAPACITY) {
        endless.insert(endless.end(), bounded.begin(), bounded.end());
        bounded.clear();
    }
    Subtree rest;
    if (!bounded.empty()) {
        rest = build(bounded);
        tree.reserve = (width - 1) * (rest.depth - 1);
    }
    // The tree's root comes first of all: a walk that meets it first finds the nearest first.
    const auto lists = static_cast<u32>((endless.size() + width - 1) / width);
    tree.roots = lists + (bounded.empty() ? 0 : 1);
    for (LayoutNode& node : rest.nodes) {
        for (u32& c : node.child)
            if ((c & NODE_INNER) != 0) c += lists;
    }
    if (!rest.nodes.empty()) tree.nodes.push_back(rest.nodes[0]);
    list(tree, endless);
    if (!rest.nodes.empty()) tree.nodes.insert(tree.nodes.end(), rest.nodes.begin() + 1, rest.nodes.end());
    tree.stack = std::min(width * tree.roots, most_upfront) + tree.reserve;
    return tree;
}

} // namespace clucida::scene
