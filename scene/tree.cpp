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

/// Nodes to reserve: a little more than spheres at random take (0.3 a box). Growing step by step holds twice as many.
std::size_t room_for(Items items)
{
    return items.size() / 3 + 1;
}

std::size_t grow(std::vector<LayoutNode>& nodes, std::size_t at, Items items);

/// A subtree of its own, made beside others: the first node is its root, inner references count from there.
struct Subtree {
    std::vector<LayoutNode> nodes;
    std::size_t depth;
    explicit Subtree(Items items)
    {
        nodes.reserve(room_for(items));
        nodes.push_back(empty_node());
        depth = grow(nodes, 0, items);
    }
};

/// Makes the node there the root over the items; what is beneath it goes to the end. Returns how many nodes lie on the
/// longest way down.
std::size_t grow(std::vector<LayoutNode>& nodes, std::size_t at, Items items)
{
    const std::vector<Items> parts = parts_of(items);
    std::vector<std::future<Subtree>> pending(parts.size());
    for (std::size_t lane = 0; lane < parts.size(); lane++)
        if (parts[lane].size() >= least_parallel)
            pending[lane] = std::async(std::launch::async, [part = parts[lane]] { return Subtree(part); });
    std::size_t depth = 0;
    for (std::size_t lane = 0; lane < parts.size(); lane++) {
        const Items part = parts[lane];
        if (part.size() == 1) {
            set_child(nodes[at], lane, part[0].box, part[0].object);
            continue;
        }
        const auto root = static_cast<u32>(nodes.size());
        set_child(nodes[at], lane, around(part), NODE_INNER | root);
        if (!pending[lane].valid()) {
            nodes.push_back(empty_node());
            depth = std::max(depth, grow(nodes, root, part));
            continue;
        }
        const Subtree made = pending[lane].get();
        for (LayoutNode node : made.nodes) {
            for (u32& child : node.child)
                if ((child & NODE_INNER) != 0) child += root;
            nodes.push_back(node);
        }
        depth = std::max(depth, made.depth);
    }
    return depth + 1;
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
        tree.reserve = (width - 1) * (grow(tree.nodes, 0, bounded) - 1);
    }
    tree.stack = std::min(width * tree.roots, most_upfront) + tree.reserve;
    return tree;
}

} // namespace clucida::scene
