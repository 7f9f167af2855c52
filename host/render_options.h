/// What `render` is asked for on the command line.
#pragma once

#include "host/picture_file.h"
#include "host/quality_choice.h"
#include "host/renderer.h"
#include "host/scene_source.h"
#include "host/stereo.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace clucida::host {

struct RenderOptions {
    SceneOptions scene;
    std::vector<std::string> outputs;
    std::string format_out, size = "640x360", tile, device, precision = "float", kernel = "auto";
    std::optional<std::string> frames;
    std::string shard, stereo;
    unsigned samples = 1, depth = 8, quality = 90, in_flight = 3;
    std::optional<unsigned> max_hops;
    std::optional<double> cutoff, eye_separation, screen_distance;
    std::optional<double> max_error = {};                ///< RMSE, linear light
    bool samples_given = false, precision_given = false; ///< by the command line, and so not to be chosen
    std::optional<QualityChoice> error_choice = {};      ///< what max_error led to; none: without calibration
    bool quiet = false, json = false, overwrite = false, skip_existing = false, no_kernel_cache = false,
         dry_run = false;
};

void add_render_options(CLI::App& command, RenderOptions& options);
/// Those of them that say how rays are traced, and on which device.
void add_tracing_options(CLI::App& command, RenderOptions& options);

/// @throws UsageError
RenderSettings settings_of(const RenderOptions& o);
scene::View view_of(const RenderOptions& o, const SceneSource& source);
Stereo stereo_of(const RenderOptions& o);

/// How its pictures are encoded, and what their metadata say but for the device and the frame.
EncodeOptions encoding_of(const RenderOptions& o, const SceneSource& source);

/// The devices that are asked for; says on standard error which they are. @throws Failure
std::vector<Device> devices_of(const RenderOptions& o);

} // namespace clucida::host
