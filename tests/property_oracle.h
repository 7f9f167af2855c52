/// What a ray must meet among boolean trees, from the primitives' own values in a wide type: an event wherever the
/// medium changes, and how far rounding may shift it.
#pragma once

#include "native_oracle.h"
#include "property_maps.h"

#include <map>

namespace clucida::test {

using W = long double;
using Point = Wide3<W>;

/// A boolean tree over primitives, each with its numbers as the buffers hold them.
class Oracle {
public:
    explicit Oracle(const SolidPtr& s) : solid(s) { collect(s); }

    bool holds(const Point& p) const { return holds(*solid, p); }
    std::size_t members() const
    {
        std::size_t n = 0;
        for (const auto& [s, leaf] : leaves) n += leaf.members.size();
        return n;
    }
    /// False if some crossing is a matter of rounding.
    bool append_roots(const Point& o, const Point& d, std::vector<Root<W>>& roots) const
    {
        bool sure = true;
        for (const auto& [s, leaf] : leaves)
            for (const auto& member : leaf.members) sure &= member.append_roots(o, d, W(1e-4L), roots);
        return sure;
    }

private:
    void collect(const SolidPtr& s)
    {
        const std::vector<SolidPtr> parts = parts_of(s);
        for (const SolidPtr& part : parts) collect(part);
        if (!parts.empty()) return;
        leaves.try_emplace(s.get(), leaf_of<W>(Native(scene_of({s})), 0));
    }
    bool holds(const scene::Solid& s, const Point& p) const
    {
        const auto inside = [&](const SolidPtr& part) { return holds(*part, p); };
        if (const auto* n = std::get_if<scene::Complement>(&s.node)) return !inside(n->of);
        if (const auto* n = std::get_if<scene::Difference>(&s.node)) return inside(n->from) && !inside(n->take);
        if (const auto* n = std::get_if<scene::Intersection>(&s.node)) return std::ranges::all_of(n->of, inside);
        if (const auto* n = std::get_if<scene::Union>(&s.node)) return std::ranges::any_of(n->of, inside);
        return leaves.at(&s).holds(p);
    }

    SolidPtr solid;
    std::map<const scene::Solid*, Leaf<W>> leaves;
};

struct Event {
    W t, blur;
    u32 before, after;
    std::vector<u32> inside_before, inside_after;
};

struct Course {
    std::vector<u32> start; ///< the objects that hold the ray's start
    std::vector<Event> events;
};

inline std::vector<u32> holders(const std::vector<Oracle>& objects, const Point& p)
{
    std::vector<u32> ids;
    for (u32 i = 0; i < objects.size(); i++)
        if (objects[i].holds(p)) ids.push_back(i);
    return ids;
}

inline u32 medium(const std::vector<u32>& inside)
{
    return inside.empty() ? vacuum : inside[0];
}

/// What the ray meets; nothing if crossings lie so close or so flat that rounding may decide their order. A ray that
/// leaves a surface has one crossing at its start, which it has done with.
inline std::optional<Course> course_of(const std::vector<Oracle>& objects, W size, const Point& o, const Point& d,
                                       bool leaves)
{
    std::vector<Root<W>> roots;
    for (const Oracle& object : objects)
        if (!object.append_roots(o, d, roots)) return std::nullopt;
    std::ranges::sort(roots, [](const auto& a, const auto& b) { return a.t < b.t; });
    // Places some sizes away, rounded to float in the buffers and once more for each surface.
    const W reach = root(dot(o, o)) + 8 * size;
    const auto blur = [&](const Root<W>& r) { return 32 * 0x1p-24L * (reach + magnitude(r.t)) * r.slope; };
    std::vector<Root<W>> ahead;
    unsigned here = 0;
    for (const Root<W>& r : roots) {
        if (r.t > reach + 32 * size) return std::nullopt;
        if (magnitude(r.t) < blur(r))
            here++;
        else if (r.t > 0)
            ahead.push_back(r);
    }
    if (here != (leaves ? 1U : 0U)) return std::nullopt;
    for (std::size_t k = 1; k < ahead.size(); k++)
        if (ahead[k].t - ahead[k - 1].t < blur(ahead[k]) + blur(ahead[k - 1])) return std::nullopt;

    Course course;
    std::vector<u32> inside = holders(objects, along(o, d, ahead.empty() ? size : ahead[0].t / 2));
    course.start = inside;
    for (std::size_t k = 0; k < ahead.size(); k++) {
        const W after = k + 1 < ahead.size() ? (ahead[k].t + ahead[k + 1].t) / 2 : ahead[k].t + size;
        std::vector<u32> next = holders(objects, along(o, d, after));
        if (medium(next) != medium(inside))
            course.events.push_back({ahead[k].t, blur(ahead[k]), medium(inside), medium(next), inside, next});
        inside = std::move(next);
    }
    return course;
}

} // namespace clucida::test
