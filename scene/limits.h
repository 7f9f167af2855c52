/// What a scene may at most hold. docs/scene-language.md lists these for users.
#pragma once

#include <cstddef>

namespace clucida::scene::limits {

inline constexpr std::size_t text_bytes = std::size_t{256} << 20;
inline constexpr std::size_t objects = 4'000'000;
inline constexpr std::size_t members = 65536; ///< primitives of one solid, named solids counted wherever they are used
inline constexpr std::size_t nesting = 256;   ///< of a solid, named solids included
inline constexpr std::size_t lights = 65536;
inline constexpr std::size_t textures = 1024;
inline constexpr std::size_t name_length = 64; ///< muParser has a limit of its own, of 100
inline constexpr std::size_t expression_length = 4096;
inline constexpr std::size_t path_length = 4096;
inline constexpr unsigned photograph_side = 16384;
inline constexpr unsigned hops = 1'000'000;
inline constexpr unsigned frames = 1'000'000;
/// Numbers are 0 or within the range of normal 32-bit floats, for that is what the device computes with.
inline constexpr double smallest = 1.1754943508222875e-38, largest = 3.4028234663852886e38;

} // namespace clucida::scene::limits
