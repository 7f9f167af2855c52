/// The normal form that the kernels know: every boolean tree over every primitive becomes groups (convex sets or single
/// members, or their complements) joined by "and" and "or".
#pragma once

#include "scene/linear.h"
#include "scene/model.h"

#include <optional>
#include <vector>

namespace clucida::scene {

/// dot(n, p) < h, n unit.
struct HalfSpace {
    Vec3 n;
    double h = 0;
    bool operator==(const HalfSpace&) const = default;
};

struct Ball {
    Vec3 c;
    double r = 1;
    bool operator==(const Ball&) const = default;
};

/// X = m (p - c); inside where s.x X0^2 + s.y X1^2 + s.z X2^2 - 2 g X2 + w < 0.
struct Quadric {
    Vec3 c;
    Mat3 m;
    Vec3 s;
    double g = 0, w = 0;
    bool convex = false;
    /// A solid of revolution, for its bounds: radius at height z of the axis at most r0 + slope |z|, or, with a focus,
    /// 2 sqrt(focus z) at z >= 0.
    struct Revolution {
        Vec3 axis; ///< unit
        double r0 = 0, slope = 0, focus = 0;
    };
    std::optional<Revolution> revolution;
    bool operator==(const Quadric& o) const
    {
        return c == o.c && m.rows == o.m.rows && s == o.s && g == o.g && w == o.w;
    }
};

/// One of the two intervals that a line may have in a torus: within distance minor of the circle of radius major.
struct Ring {
    Vec3 c, axis; ///< axis unit
    double major = 1, minor = 0.25;
    unsigned part = 0; ///< the first or the second interval
    bool operator==(const Ring&) const = default;
};

using Member = std::variant<HalfSpace, Ball, Quadric, Ring>;

/// The intersection of its members (several only if all are convex), or the complement of that.
struct Group {
    std::vector<Member> members;
    bool inverse = false;
    bool operator==(const Group&) const = default;
};

struct Form {
    enum class Kind { group, all, any } kind = Kind::group;
    Group group;             ///< of a group
    std::vector<Form> parts; ///< of all (intersection) and any (union); never of the same kind
    bool operator==(const Form&) const = default;
};

/// Counts what a solid becomes when everything shared is expanded; stops counting at limit.
std::size_t expanded_members(const Solid& solid, std::size_t limit);

/// @throws Error at the solid that a transform flattens or that has no boundary, or at a transform that makes of a
/// torus something else
Form normal_form(const Solid& solid);

/// Whether the point is inside; nullopt if it lies within `margin` of a boundary that could decide it.
std::optional<bool> holds(const Form& form, Vec3 p, double margin);

} // namespace clucida::scene
