/// Files that tell what was measured.
#pragma once

#include "bench/speed_json.h"
#include "bench/speed_plots.h"
#include "bench/speed_table.h"

#include <filesystem>
#include <string>

namespace clucida::bench {

/// A page of its own: the plots, what is recommended for some errors, the tables, the notes.
std::string speed_page(std::span<const SceneSpeed> results, const SpeedSettings& settings, const Load& load);

/// Writes NAME.svg for each plot into the folder, which is made if need be. @throws host::Failure
void write_plots(const std::filesystem::path& folder, const std::vector<NamedPlot>& plots);

/// The folder, made if need be. @throws host::Failure
void require_folder(const std::filesystem::path& folder);

} // namespace clucida::bench
