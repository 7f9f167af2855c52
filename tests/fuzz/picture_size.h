/// What keeps the picture fuzzers from pictures that are merely large.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stb/stb_image.h>

namespace clucida::fuzz {

/// Whether a picture claims more pixels than there is time for. A header of a few bytes may claim 16384 x 16384, which
/// is allowed, and which stb_image takes memory for before it looks for the pixels.
inline bool too_large(const std::uint8_t* data, std::size_t size)
{
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, static_cast<int>(size), &width, &height, &channels) == 0) return false;
    return std::int64_t{width} * height > 1 << 18;
}

} // namespace clucida::fuzz
