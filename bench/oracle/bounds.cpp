#include "bench/oracle/bounds.h"

#include <utility>

namespace clucida::oracle {
namespace {

// Beyond this an extent counts as unbounded.
constexpr double far = 1e7;
constexpr std::size_t most_planes = 100;

Box everything()
{
    return {};
}

Box common(const Box& a, const Box& b)
{
    Box c;
    for (std::size_t i = 0; i < 3; i++) {
        c.low[i] = std::max(a.low[i], b.low[i]);
        c.high[i] = std::min(a.high[i], b.high[i]);
    }
    return c;
}

Box around(const Box& a, const Box& b)
{
    Box c;
    for (std::size_t i = 0; i < 3; i++) {
        c.low[i] = std::min(a.low[i], b.low[i]);
        c.high[i] = std::max(a.high[i], b.high[i]);
    }
    return c;
}

/// The corner of three planes if it lies behind all others.
std::optional<Vec<double>> corner(const std::vector<HalfSpace>& planes, std::size_t i, std::size_t j, std::size_t k)
{
    const HalfSpace &a = planes[i], &b = planes[j], &c = planes[k];
    const double det = dot(a.n, cross(b.n, c.n));
    if (std::fabs(det) < 1e-9) return std::nullopt;
    const Vec<double> p = (cross(b.n, c.n) * a.h + cross(c.n, a.n) * b.h + cross(a.n, b.n) * c.h) * (1 / det);
    const double slack = 1e-7 * (1 + size_of(p));
    for (std::size_t m = 0; m < planes.size(); m++) {
        if (m == i || m == j || m == k) continue;
        if (dot(planes[m].n, p) > planes[m].h + slack) return std::nullopt;
    }
    return p;
}

/// The box about all corners of the polyhedron that the planes leave of a very large cube.
Box polyhedron(std::vector<HalfSpace> planes)
{
    if (planes.empty()) return everything();
    if (planes.size() > most_planes) planes.resize(most_planes);
    for (const double sign : {-1.0, 1.0}) {
        planes.push_back({{sign, 0, 0}, far});
        planes.push_back({{0, sign, 0}, far});
        planes.push_back({{0, 0, sign}, far});
    }
    Box box{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (std::size_t i = 0; i < planes.size(); i++) {
        for (std::size_t j = i + 1; j < planes.size(); j++) {
            for (std::size_t k = j + 1; k < planes.size(); k++) {
                if (const auto p = corner(planes, i, j, k)) {
                    const Box point{{p->x, p->y, p->z}, {p->x, p->y, p->z}};
                    box = around(box, point);
                }
            }
        }
    }
    if (box.low[0] > box.high[0]) return everything(); // no corner: an empty solid, or one that rounding spoiled
    for (std::size_t i = 0; i < 3; i++) {
        if (box.low[i] < -0.5 * far) box.low[i] = -HUGE_VAL;
        if (box.high[i] > 0.5 * far) box.high[i] = HUGE_VAL;
    }
    return box;
}

struct Bounding {
    const Tree& tree;
    const std::vector<Enclosure>& enclosures;

    /// Whether a leaf is a half-space, whose complement is one too.
    static bool half_space(const Enclosure& e) { return e.size() == 1; }

    /// Gathers half-spaces of nested intersections, and the boxes of what else is intersected with them.
    void gather(std::uint32_t at, bool complement, std::vector<HalfSpace>& planes, Box& box) const
    {
        const Tree::Node& node = tree.nodes[at];
        using Kind = Tree::Kind;
        if (node.kind == Kind::complement) {
            gather(node.of[0], !complement, planes, box);
        } else if (node.kind == Kind::primitive) {
            const Enclosure& e = enclosures[node.primitive];
            if (!complement)
                planes.insert(planes.end(), e.begin(), e.end());
            else if (half_space(e))
                planes.push_back({-e[0].n, -e[0].h});
        } else if ((node.kind == Kind::all) != complement) {
            for (const std::uint32_t child : node.of) gather(child, complement, planes, box);
        } else {
            Box sum{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
            for (const std::uint32_t child : node.of) sum = around(sum, of(child, complement));
            box = common(box, sum);
        }
    }

    Box of(std::uint32_t at, bool complement) const
    {
        std::vector<HalfSpace> planes;
        Box box;
        gather(at, complement, planes, box);
        return common(box, polyhedron(std::move(planes)));
    }
};

} // namespace

Box bounds_of(const Tree& tree, const std::vector<Enclosure>& enclosures)
{
    Box box = Bounding{tree, enclosures}.of(tree.root, false);
    for (std::size_t i = 0; i < 3; i++) {
        const double margin = 1e-5 * (std::fabs(box.low[i]) + std::fabs(box.high[i])) + 1e-9;
        if (std::isfinite(margin)) {
            box.low[i] -= margin;
            box.high[i] += margin;
        } else {
            box.low[i] -= 1e-5 * std::fabs(box.low[i]);
            box.high[i] += 1e-5 * std::fabs(box.high[i]);
        }
    }
    return box;
}

std::optional<double> entry(const Box& box, const Ray<double>& ray)
{
    double first = 0, last = HUGE_VAL;
    const std::array<double, 3> o{ray.o.x, ray.o.y, ray.o.z}, d{ray.d.x, ray.d.y, ray.d.z};
    for (std::size_t i = 0; i < 3; i++) {
        if (d[i] == 0) {
            if (o[i] < box.low[i] || o[i] > box.high[i]) return std::nullopt;
            continue;
        }
        const double a = (box.low[i] - o[i]) / d[i], b = (box.high[i] - o[i]) / d[i];
        first = std::max(first, std::min(a, b) * (1 - 1e-12));
        last = std::min(last, std::max(a, b) * (1 + 1e-12));
    }
    if (first > last) return std::nullopt;
    return first;
}

} // namespace clucida::oracle
