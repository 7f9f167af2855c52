/// What a fuzzer of a reader does with a text.
#pragma once

#include "scene/read.h"

#include <cstddef>
#include <cstdint>

namespace clucida::fuzz {

/// Reads the text; what is wrong must be said by a scene::Error. What reads well is printed and read back to an equal
/// scene, and compiled to buffers. Ends the process where any of it is not so. Photographs come from tests/data/scenes
/// alone.
void try_text(const std::uint8_t* data, std::size_t size, scene::Format format);

} // namespace clucida::fuzz
