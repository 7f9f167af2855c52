#include "scene/model.h"

#include <set>
#include <type_traits>
#include <utility>

namespace clucida::scene {
namespace {

using Pair = std::pair<const Solid*, const Solid*>;

bool is_composite(const Solid& solid)
{
    return std::visit(
        [](const auto& node) {
            using Node = std::decay_t<decltype(node)>;
            return std::is_same_v<Node, Complement> || std::is_same_v<Node, Intersection> ||
                   std::is_same_v<Node, Union> || std::is_same_v<Node, Difference> || std::is_same_v<Node, Transformed>;
        },
        solid.node);
}

/// Compares two nodes without what they are made of, which it appends to be compared later.
bool same_node(const Solid& a, const Solid& b, std::vector<Pair>& parts)
{
    const auto list = [&](const std::vector<SolidPtr>& x, const std::vector<SolidPtr>& y) {
        if (x.size() != y.size()) return false;
        for (std::size_t i = 0; i < x.size(); ++i) parts.emplace_back(x[i].get(), y[i].get());
        return true;
    };
    if (a.node.index() != b.node.index()) return false;
    return std::visit(
        [&](const auto& x) {
            using Node = std::decay_t<decltype(x)>;
            const auto& y = std::get<Node>(b.node);
            if constexpr (std::is_same_v<Node, Complement>) {
                parts.emplace_back(x.of.get(), y.of.get());
                return true;
            } else if constexpr (std::is_same_v<Node, Intersection> || std::is_same_v<Node, Union>) {
                return list(x.of, y.of);
            } else if constexpr (std::is_same_v<Node, Difference>) {
                parts.emplace_back(x.from.get(), y.from.get());
                parts.emplace_back(x.take.get(), y.take.get());
                return true;
            } else if constexpr (std::is_same_v<Node, Transformed>) {
                parts.emplace_back(x.of.get(), y.of.get());
                return x.by == y.by;
            } else {
                return x == y;
            }
        },
        a.node);
}

} // namespace

// Solids share nodes, so a tree's size can be exponential in the number of its nodes: a pair is compared once. A name
// is a handle to a solid and no part of its value.
bool operator==(const Solid& a, const Solid& b)
{
    std::vector<Pair> left{{&a, &b}};
    std::set<Pair> seen;
    while (!left.empty()) {
        const Pair pair = left.back();
        left.pop_back();
        if (pair.first == pair.second) continue;
        if (pair.first == nullptr || pair.second == nullptr) return false;
        if (is_composite(*pair.first) && !seen.insert(pair).second) continue;
        if (!same_node(*pair.first, *pair.second, left)) return false;
    }
    return true;
}

bool operator==(const Object& a, const Object& b)
{
    if (a.name != b.name || a.optics != b.optics || a.texture != b.texture) return false;
    if (a.solid == b.solid) return true;
    return a.solid != nullptr && b.solid != nullptr && *a.solid == *b.solid;
}

} // namespace clucida::scene
