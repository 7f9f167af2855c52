/// What a picture costs however small it is.
#pragma once

#include "bench/speed_task.h"

#include <cstddef>
#include <filesystem>

namespace clucida::bench {

/// Seconds, but for what says otherwise.
struct FixedCosts {
    double read = 0, compile = 0;                     ///< the scene: its text, its buffers
    double cold_build = 0, cold_launch = 0;           ///< the program, with an empty cache; its first launch
    double cached_build = 0, cached_launch = 0;       ///< in another process, with what that left
    double upload = 0;                                ///< the scene's way to the device
    std::size_t scene_bytes = 0;                      ///< that go
    double empty_launch = 0;                          ///< of a work-group without samples, its buffers included
    double way_back = 0;                              ///< what tracing takes beyond the kernels' own time
    std::size_t picture_bytes = 0, counter_bytes = 0; ///< that come back
};

/// Compiles the contender's program twice, in processes of their own, which leave in the folder what their OpenCL
/// implementation keeps. Sets the builds and launches only. @throws host::Failure
FixedCosts measure_builds(const SpeedTask& task, const std::filesystem::path& folder);

/// Renders the picture some times. Sets all but the builds and launches. @throws host::Failure, host::Interrupted
void measure_rest(const host::SceneOptions& scene, const scene::View& view, const host::Device& device,
                  const host::RenderSettings& settings, unsigned rounds, FixedCosts& costs);

} // namespace clucida::bench
