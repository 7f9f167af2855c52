/// Where two paths part: the kernels' path of a pixel beside the oracle's.
#pragma once

#include "bench/oracle/path.h"

#include <cstddef>
#include <span>
#include <vector>

namespace clucida::bench {

/// A segment of a way, and the branch by which the way goes on: EVENT_REFLECTED, EVENT_REFRACTED, or 0 at its end.
struct Step {
    oracle::Event event;
    std::uint32_t branch = 0;
    std::size_t place = 0; ///< the event's, in the path that it is of
};

/// A segment whose events differ, though the surfaces before it on the way are the same.
struct Divergence {
    std::vector<Step> way; ///< the kernels', from the observer's segment to this one, this included
    oracle::Event oracle;  ///< what the oracle has in place of the last
};

/// Whether an event leads on along a way: the step's surface and its branch followed, or the same event at the end.
bool goes(const oracle::Event& event, const Step& step);

/// Both paths as events in pre-order (oracle::Event), with faces already named alike. Where surfaces differ, or one
/// path ends, what follows is not compared; where only lights or the branches followed differ, what both follow is.
std::vector<Divergence> divergences(std::span<const oracle::Event> kernel, std::span<const oracle::Event> oracle);

/// Whether the path goes the divergence's way: the same surfaces along it, and the same event at its end.
bool has_way(std::span<const oracle::Event> path, const Divergence& divergence);

} // namespace clucida::bench
