/// A contender at work, in the process that is its own.
#pragma once

#include "bench/speed_task.h"
#include "host/renderer.h"

#include <functional>
#include <string>

namespace clucida::bench {

struct Racer {
    /// Renders the picture's upper left part, or all of it. All that is needed is compiled then; capacities that proved
    /// too small stay enlarged.
    std::function<host::Frame(host::Shape part)> render;
    std::string what;    ///< the device or the compiler
    std::string options; ///< that select the scene's variant of the kernels
    unsigned threads = 0;
};

/// @throws host::Failure, host::UsageError, scene::Error
Racer make_racer(const SpeedTask& task);

} // namespace clucida::bench
