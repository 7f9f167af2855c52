/// `render --max-error`: settings chosen by what `clucida-bench` has measured on this device.
#pragma once

#include "host/render_options.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace clucida::host {

/// Where --max-error is given, sets the precision, samples, hops and cutoff that the command line leaves open, and says
/// on standard error which they are, and the error to expect. Without calibration the most accurate are taken: double
/// where the device has it. hash is of the scene's text, or empty where scenes are still to come.
/// @throws UsageError together with --as-original, Failure if there is no such device
void choose_by_error(RenderOptions& options, const std::string& hash);

/// What was chosen, and why; null where --max-error is not given.
nlohmann::ordered_json error_choice_json(const RenderOptions& options);

} // namespace clucida::host
