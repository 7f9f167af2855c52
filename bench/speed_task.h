/// What is raced: a scene's picture by a contender. Told to the contender's process as JSON.
#pragma once

#include "bench/native_library.h"
#include "host/renderer.h"
#include "host/scene_source.h"
#include "host/tiling.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace clucida::bench {

/// What of a picture's settings changes its error with its time.
struct SpeedView {
    host::Shape picture{640, 360};
    unsigned samples = 1;                  ///< of each pixel
    std::optional<unsigned> max_hops = {}; ///< else the scene's
    std::optional<double> cutoff = {};     ///< likewise
    bool operator==(const SpeedView&) const = default;
};

struct SpeedContender {
    std::string device; ///< P:D; empty: the native build
    host::Precision precision = host::Precision::single;
    unsigned threads = 0;                         ///< 0: as many as there are
    std::optional<host::KernelShape> kernel = {}; ///< else the one that is made for the device
    std::optional<host::Shape> group = {};        ///< work-items of a group of the kernel of pixels; else chosen
    SpeedView view = {};
    bool operator==(const SpeedContender&) const = default;
};

inline bool is_native(const SpeedContender& c)
{
    return c.device.empty();
}

/// Whether one process can be both: all but the view is the same.
bool same_process(const SpeedContender& a, const SpeedContender& b);

/// Whether what one has compiled serves the other.
bool same_program(const SpeedContender& a, const SpeedContender& b);

struct SpeedTask {
    host::SceneOptions scene;
    SpeedContender contender;
    NativeBuild native;                           ///< of a native contender
    unsigned least_interior = 0, least_stack = 0; ///< capacities to begin with, where the scene's are less
};

scene::View view_of(const SpeedView& view);

nlohmann::ordered_json to_json(const SpeedView& view);
nlohmann::ordered_json to_json(const SpeedTask& task);

/// What the JSON lacks is as in `otherwise`. @throws nlohmann::json::exception
SpeedView speed_view_of(const nlohmann::json& j, const SpeedView& otherwise);

/// What the JSON lacks is as in an empty task. @throws nlohmann::json::exception
SpeedTask task_of(const nlohmann::json& j);

} // namespace clucida::bench
