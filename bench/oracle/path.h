/// What a ray met on its way, in terms that the kernels and the oracle share.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace clucida::oracle {

inline constexpr std::uint32_t vacuum = 0xffffffffU; ///< no object

/// Bits of Event::what.
enum What : std::uint32_t {
    what_entering = 1,  ///< the object is entered, not left
    what_reflected = 2, ///< a reflected branch was followed
    what_refracted = 4, ///< a refracted branch was followed
    what_total = 8,     ///< total reflection
    what_emitted = 16,  ///< an emitter ended the ray
};

/// One traced segment, in pre-order: the segment, then all of its reflection, then all of its refraction. A branch that
/// would be black at once (cutoff, no hops left, an opaque medium, no throughput) is not traced and has no event.
struct Event {
    std::uint32_t hop = 0;         ///< 0 for the observer's segment
    std::uint32_t object = vacuum; ///< the highest-precedence object among those left and entered; none: the sky
    std::uint32_t face = vacuum;   ///< which of the object's primitive surfaces; none for the sky
    std::uint32_t what = 0;
    std::uint32_t lights = 0; ///< bit i mod 32: light i lit this surface; 0 where absorption is not evaluated
    bool operator==(const Event&) const = default;
};

struct Path {
    std::vector<Event> events;
    std::array<double, 3> rgb{};
    double truncated = 0; ///< summed weight (its largest channel, passthrough included) of what cutoff or hops ended
};

} // namespace clucida::oracle
