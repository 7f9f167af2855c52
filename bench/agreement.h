/// How far one scene's pictures by two devices are apart, value by value and path by path.
#pragma once

#include "host/child_process.h"
#include "host/tiling.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::bench {

/// A device as the user names it, in a process with an environment of its own.
struct Place {
    std::string name;              ///< as it was given
    std::string selector;          ///< as for `--device`
    host::Environment environment; ///< what the process has besides this one's
};

/// "RUSTICL_ENABLE=llvmpipe rusticl": assignments as the program env takes them, then the device.
/// @throws host::UsageError if no device follows them
Place parse_place(std::string_view text);

/// What one place made of a scene by one kernel in one precision.
struct Render {
    std::vector<std::uint32_t> rgb; ///< the bits of linear floats
    std::vector<std::uint32_t>
        paths; ///< of each pixel's first sample the hash of its events; none where they are not told
};

/// How far two renders are apart.
struct Agreement {
    std::size_t values = 0, equal = 0; ///< channels; those of the same bits
    std::uint64_t most_ulps = 0;       ///< floats between two values at most
    unsigned most_steps = 0;           ///< of 8-bit sRGB
    std::size_t pixels = 0, over = 0;  ///< pixels; those more than one step apart
    std::size_t paths = 0;             ///< pixels whose paths both tell
    std::size_t flips = 0;             ///< those of them whose paths differ
    std::size_t other = 0;             ///< pixels that differ though their paths do not
};

/// Floats from one to the other, over all between them; the most there can be where one is not a number.
std::uint64_t ulps_between(std::uint32_t a, std::uint32_t b);

/// size: of both. @throws host::Failure if they are not of that size
Agreement agree(const Render& a, const Render& b, host::Shape size);

/// Both together: counts are added, and of the largest the larger counts.
Agreement united(const Agreement& a, const Agreement& b);

} // namespace clucida::bench
