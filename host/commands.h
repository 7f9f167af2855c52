/// The subcommands of `clucida`, one file each. Each adds itself with its options to the program; the work is done in
/// the subcommand's callback, which throws what errors.h and scene/error.h name.
#pragma once

#include "host/scene_source.h"

#include <CLI/CLI.hpp>

namespace clucida::host {

void add_render(CLI::App& app);
void add_devices(CLI::App& app);
void add_inspect(CLI::App& app);
void add_compare(CLI::App& app);
void add_stream(CLI::App& app);

/// SCENE, --format, --allow-path and --as-original.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// A number in that range, which NaN is not.
CLI::Validator number_within(double least, double most);

} // namespace clucida::host
