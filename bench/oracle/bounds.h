/// A box about an object, so that rays that pass it by need not look at it. In double, with generous margins.
#pragma once

#include "bench/oracle/solids.h"

#include <optional>

namespace clucida::oracle {

struct Box {
    std::array<double, 3> low{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, high{HUGE_VAL, HUGE_VAL, HUGE_VAL};
};

/// dot(n, p) <= h.
struct HalfSpace {
    Vec<double> n;
    double h = 0;
};

/// What a primitive surely lies within; nothing for those that no half-space holds.
using Enclosure = std::vector<HalfSpace>;

Box bounds_of(const Tree& tree, const std::vector<Enclosure>& enclosures);

/// Where the ray enters the box, 0 if it starts within; nothing if it misses it.
std::optional<double> entry(const Box& box, const Ray<double>& ray);

} // namespace clucida::oracle
