/// A contender at work, in the process that is its own.
#pragma once

#include "bench/speed_task.h"
#include "host/renderer.h"

#include <functional>
#include <optional>
#include <string>

namespace clucida::bench {

struct Racer {
    /// Renders the picture's upper left part in one launch; without a part all of it, in launches of as much time as
    /// `clucida render` gives them. All that is needed is compiled then; capacities that proved too small stay
    /// enlarged.
    std::function<host::Frame(const SpeedView& view, std::optional<host::Shape> part)> render;
    std::string what;              ///< the device or the compiler
    unsigned threads = 0;          ///< 0: a device that has none to speak of
    std::size_t objects = 0;       ///< of the scene
    std::uint64_t scene_bytes = 0; ///< of the buffers that the device is given
};

/// @throws host::Failure, host::UsageError, scene::Error
Racer make_racer(const SpeedTask& task);

} // namespace clucida::bench
