/// All crossings of a ray in order, and what holds the stretches between them.
#pragma once

#include "bench/oracle/oracle.h"

#include <algorithm>

namespace clucida::oracle {

/// Crossings that lie this close, in parts of the numbers they come from, are one: faces that a text means to be flush
/// differ by the rounding of its decimals. It is far from the rounding of double, and from anything that is meant.
inline constexpr double coincidence = 1e-11;

template <class Real>
struct Crossing {
    Real t = 0;
    double slack = 0; ///< what lies nearer than this is the same crossing
    std::uint32_t object = 0, face = 0;
};

/// An object whose box the ray meets.
struct Candidate {
    double entry = 0;
    std::uint32_t object = 0;
};

template <class Real>
std::vector<Candidate> candidates_of(const World<Real>& world, const Ray<double>& ray, double within)
{
    std::vector<Candidate> found;
    for (std::uint32_t i = 0; i < world.objects.size(); i++) {
        const auto at = entry(world.objects[i].box, ray);
        if (at && *at <= within) found.push_back({*at, i});
    }
    std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
        return a.entry != b.entry ? a.entry < b.entry : a.object < b.object;
    });
    return found;
}

/// How a ray starts: in known surfaces, or anywhere.
struct Start {
    std::span<const Surface> left;
    bool anywhere = false; ///< surfaces within the tolerance of the start count as left
};

template <class Real>
struct Line {
    Ray<Real> ray;
    Ray<double> rough;
    double size = 0;
    Start start;

    Line(const Ray<Real>& r, Start s)
        : ray(r), rough{converted<double>(r.o), converted<double>(r.d)}, size(size_of(r.o)), start(s)
    {
    }

    double slack(const Real& t, const Primitive<Real>& p) const
    {
        return coincidence * (size + std::fabs(to_double(t)) + p.extent);
    }
    bool leaves(std::uint32_t object, std::uint32_t face) const
    {
        return std::find(start.left.begin(), start.left.end(), Surface{object, face}) != start.left.end();
    }
};

/// How far along the ray a disturbance moves a crossing.
template <class Real>
double merging_slack(const World<Real>& world, const Line<Real>& line, const Real& t, const Primitive<Real>& p)
{
    constexpr double most_slope = 1e4;
    const Vec<Real> at = line.ray.o + line.ray.d * t, g = gradient_at(p, at);
    const double steep = std::fabs(to_double(Real(dot(g, line.ray.d)))),
                 size = to_double(length(at - world.observer.eye));
    const double slope = std::min(to_double(length(g)) / std::max(steep, 1e-300), most_slope);
    return world.disturbance->size * std::max(size, to_double(t)) * slope;
}

/// An object along the line: its primitives' functions, appended to alongs, and its crossings ahead, to crossings.
template <class Real>
void look_at(const World<Real>& world, const Line<Real>& line, std::uint32_t index, std::vector<Along<Real>>& alongs,
             std::vector<Crossing<Real>>& crossings)
{
    const Object<Real>& object = world.objects[index];
    for (std::uint32_t i = 0; i < object.primitives.size(); i++) {
        const Primitive<Real>& p = object.primitives[i];
        const Along<Real> q = along(p, object.rough[i], line.ray, line.rough, line.leaves(index, i));
        for_crossings(p, q, line.ray, [&](const Real& t) {
            if (!(t > 0)) return;
            double slack = line.slack(t, p);
            if (world.disturbance && world.disturbance->merging) slack = merging_slack(world, line, t, p);
            if (line.start.anywhere && t <= slack) return;
            crossings.push_back({t, slack, index, i});
        });
        alongs.push_back(q);
    }
}

template <class Real>
bool earlier(const Crossing<Real>& a, const Crossing<Real>& b)
{
    if (a.t != b.t) return a.t < b.t;
    return a.object != b.object ? a.object < b.object : a.face < b.face;
}

/// Goes along a ray from one cluster of crossings to the next.
template <class Real>
class Walk {
public:
    Walk(const World<Real>& world, const Line<Real>& line)
        : world_(world), line_(line), candidates_(candidates_of(world, line.rough, HUGE_VAL))
    {
    }

    struct Result {
        std::uint32_t before = vacuum; ///< the medium in force at the start
        std::optional<Hit<Real>> hit;
    };

    Result to_surface()
    {
        Result result;
        Cluster here = cluster(0);
        Real low = 0, middle = middle_of(low, here);
        result.before = medium_at(middle);
        while (here.end > here.begin) {
            for (std::size_t i = here.begin; i < here.end; i++) loaded_of(crossings_[i].object).known = false;
            low = crossings_[here.end - 1].t;
            const Cluster beyond = cluster(here.end);
            const Real middle_before = middle;
            middle = middle_of(low, beyond);
            const std::uint32_t after = medium_at(middle);
            // A disturbed ray may start where no such start can be: what then changes between crossings is not met.
            if (after != result.before && crosses(here, std::min(after, result.before))) {
                result.hit = hit(here, middle_before, result.before, after);
                return result;
            }
            here = beyond;
        }
        return result;
    }

private:
    /// crossings_[begin] to crossings_[end - 1]; empty if there are none left.
    struct Cluster {
        std::size_t begin = 0, end = 0;
    };

    bool crosses(const Cluster& here, std::uint32_t object) const
    {
        for (std::size_t i = here.begin; i < here.end; i++)
            if (crossings_[i].object == object) return true;
        return false;
    }

    struct Loaded {
        std::uint32_t object = 0;
        std::size_t alongs = 0; ///< where its primitives' functions begin
        bool known = false, inside = false;
    };

    Loaded& loaded_of(std::uint32_t object)
    {
        return *std::find_if(loaded_.begin(), loaded_.end(), [&](const Loaded& l) { return l.object == object; });
    }

    bool more() const { return next_candidate_ < candidates_.size(); }
    double next_entry() const { return candidates_[next_candidate_].entry; }

    void load(std::size_t begin)
    {
        const Candidate candidate = candidates_[next_candidate_++];
        loaded_.push_back({candidate.object, alongs_.size()});
        const auto before = static_cast<std::ptrdiff_t>(crossings_.size());
        look_at(world_, line_, candidate.object, alongs_, crossings_);
        // Outside its box primitives are crossed, but never the object's boundary.
        crossings_.erase(std::remove_if(crossings_.begin() + before, crossings_.end(),
                                        [&](const Crossing<Real>& c) { return to_double(c.t) < candidate.entry; }),
                         crossings_.end());
        std::sort(crossings_.begin() + static_cast<std::ptrdiff_t>(begin), crossings_.end(), earlier<Real>);
    }

    /// The crossings from number begin on that coincide, each with the next. Objects that begin farther off wait.
    Cluster cluster(std::size_t begin)
    {
        while (true) {
            while (more() && (begin == crossings_.size() || reaches(crossings_[begin]))) load(begin);
            if (begin == crossings_.size()) return {begin, begin};
            std::size_t end = begin + 1;
            while (end < crossings_.size() && coincide(crossings_[end - 1], crossings_[end])) end++;
            if (!more() || !reaches(crossings_[end - 1])) return {begin, end};
            load(begin);
        }
    }

    bool reaches(const Crossing<Real>& c) const { return next_entry() <= to_double(c.t) + 2 * c.slack; }
    static bool coincide(const Crossing<Real>& a, const Crossing<Real>& b)
    {
        return to_double(Real(b.t - a.t)) <= std::max(a.slack, b.slack);
    }

    Real middle_of(const Real& low, const Cluster& beyond) const
    {
        if (beyond.end > beyond.begin) return (low + crossings_[beyond.begin].t) / Real(2);
        return low + low + Real(1 + line_.size);
    }

    bool inside(const Loaded& loaded, std::uint32_t face, const Real& t) const
    {
        return inside_at(world_.objects[loaded.object].primitives[face], alongs_[loaded.alongs + face], line_.ray, t);
    }

    /// The medium in force at t, which lies between clusters. An object's membership changes in its crossings only.
    std::uint32_t medium_at(const Real& t)
    {
        std::uint32_t medium = vacuum;
        for (Loaded& l : loaded_) {
            if (!l.known) {
                const Tree& tree = world_.objects[l.object].tree;
                l.inside = contains(tree, tree.root, [&](std::uint32_t face) { return inside(l, face, t); });
                l.known = true;
            }
            if (l.inside) medium = std::min(medium, l.object);
        }
        return medium;
    }

    /// The face of the object that shows: the first in the cluster to change the object's membership.
    std::uint32_t face_of(const Cluster& here, const Loaded& loaded, const Real& t_before, Real& t) const
    {
        const Tree& tree = world_.objects[loaded.object].tree;
        std::vector<bool> in(world_.objects[loaded.object].primitives.size());
        for (std::uint32_t i = 0; i < in.size(); i++) in[i] = inside(loaded, i, t_before);
        const auto whole = [&] {
            return contains(tree, tree.root, [&](std::uint32_t face) { return bool(in[face]); });
        };
        const bool at_first = whole();
        std::uint32_t first = vacuum;
        for (std::size_t i = here.begin; i < here.end; i++) {
            const Crossing<Real>& c = crossings_[i];
            if (c.object != loaded.object) continue;
            if (first == vacuum) {
                first = c.face;
                t = c.t;
            }
            in[c.face] = !in[c.face];
            if (whole() == at_first) continue;
            t = c.t;
            return c.face;
        }
        return first;
    }

    Hit<Real> hit(const Cluster& here, const Real& t_before, std::uint32_t before, std::uint32_t after)
    {
        Hit<Real> h;
        h.before = before;
        h.after = after;
        h.object = std::min(before, after); // if lower ones are left or entered, this one decides
        h.face = face_of(here, loaded_of(h.object), t_before, h.t);
        h.point = line_.ray.o + line_.ray.d * h.t;
        const Vec<Real> gradient = gradient_at(world_.objects[h.object].primitives[h.face], h.point);
        const Real size = length(gradient);
        // At an apex there is no normal: the ray's own direction stands in.
        const Vec<Real> n = size > 0 ? gradient * (Real(1) / size) : line_.ray.d;
        const bool entering = h.object == after;
        h.normal = (dot(n, line_.ray.d) < 0) == entering ? n : -n;
        for (std::size_t i = here.begin; i < here.end; i++) {
            const Surface s{crossings_[i].object, crossings_[i].face};
            if (std::find(h.surfaces.begin(), h.surfaces.end(), s) == h.surfaces.end()) h.surfaces.push_back(s);
        }
        return h;
    }

    const World<Real>& world_;
    const Line<Real>& line_;
    std::vector<Candidate> candidates_;
    std::size_t next_candidate_ = 0;
    std::vector<Loaded> loaded_;
    std::vector<Along<Real>> alongs_;
    std::vector<Crossing<Real>> crossings_;
};

/// Whether any solid lies on the open stretch from a surface, seen from vacuum, to a light at a distance.
template <class Real>
bool hidden(const World<Real>& world, const Line<Real>& line, const Real& distance)
{
    std::vector<Along<Real>> alongs;
    std::vector<Crossing<Real>> crossings;
    for (const Candidate& candidate : candidates_of(world, line.rough, to_double(distance))) {
        alongs.clear();
        crossings.clear();
        look_at(world, line, candidate.object, alongs, crossings);
        std::sort(crossings.begin(), crossings.end(), earlier<Real>);
        const Object<Real>& object = world.objects[candidate.object];
        const auto holds = [&](const Real& from, const Real& to) {
            const Real t = (from + to) / Real(2);
            return contains(object.tree, object.tree.root, [&](std::uint32_t face) {
                return inside_at(object.primitives[face], alongs[face], line.ray, t);
            });
        };
        Real low = 0;
        double slack = 0;
        for (const Crossing<Real>& c : crossings) {
            if (to_double(Real(distance - c.t)) <= c.slack) break; // beyond the light, or just where it is
            if (to_double(Real(c.t - low)) > slack && holds(low, c.t)) return true;
            low = c.t;
            slack = c.slack;
        }
        if (holds(low, distance)) return true;
    }
    return false;
}

template <class Real>
std::optional<Hit<Real>> next(const World<Real>& world, const std::array<Real, 3>& o, const std::array<Real, 3>& d,
                              std::span<const Surface> left)
{
    const Ray<Real> ray{{o[0], o[1], o[2]}, unit(Vec<Real>{d[0], d[1], d[2]})};
    const Line<Real> line(ray, {left, left.empty()});
    return Walk<Real>(world, line).to_surface().hit;
}

} // namespace clucida::oracle
