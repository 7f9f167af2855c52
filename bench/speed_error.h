/// How far a picture is from right, told from some of its pixels.
#pragma once

#include "bench/truth.h"
#include "host/picture.h"
#include "host/scene_source.h"
#include "host/tiling.h"

#include <cstddef>
#include <span>
#include <vector>

namespace clucida::bench {

/// At most that many pixels on a regular grid over the whole picture, by their numbers row by row.
std::vector<std::size_t> grid_pixels(host::Shape picture, std::size_t most);

/// The oracle's colours of the pixels, each the mean of its samples, as a picture of one row.
/// @throws host::UsageError for what the oracle does not imitate, scene::Error, host::Interrupted
host::Picture true_pixels(const host::SceneSource& source, const scene::View& view, std::span<const std::size_t> pixels,
                          unsigned threads);

} // namespace clucida::bench
