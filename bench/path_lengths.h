/// How far rays go: from the paths of a picture's pixels on a grid.
#pragma once

#include "host/renderer.h"

#include <cstdint>
#include <vector>

namespace clucida::bench {

/// Of rays after so many surfaces: 0 are the observer's.
struct HopCount {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;     ///< that met a surface
    std::uint64_t branched = 0; ///< ... of which both the reflection and the refraction were followed
    std::uint64_t ended = 0;    ///< ... of which neither was, for want of weight or hops, or by what the surface is
    std::uint64_t deepest = 0;  ///< pixels none of whose rays went farther
};

struct PathLengths {
    std::size_t pixels = 0;
    std::vector<HopCount> hops;
    std::uint64_t rays = 0, hits = 0;
    std::uint64_t counted_rays = 0; ///< as the kernel's own statistics have them: the same number
    std::uint64_t unseen = 0;       ///< events beyond those that are kept of a path
};

/// Traces one sample of at most so many pixels, in the settings' precision, with a program of its own.
/// @throws host::Failure
PathLengths measure_path_lengths(const host::Device& device, const scene::Compiled& compiled,
                                 const host::RenderSettings& settings, std::size_t most_pixels);

} // namespace clucida::bench
