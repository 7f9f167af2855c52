/// What `clucida-bench speed` is asked for on the command line.
#pragma once

#include "bench/measure_speed.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace clucida::bench {

struct SpeedOptions {
    std::vector<std::string> scenes, devices;
    std::vector<std::string> precisions{"float"}, threads{"all"}, kernels{"auto"}, groups{"auto"}, sizes{"640x360"},
        samples{"1"}, max_hops{"scene"}, cutoffs{"scene"};
    std::string format, allow_path, compiler;
    std::vector<std::string> errors; ///< empty: chosen by what else is asked for
    std::string json, csv, html, svg, compare;
    unsigned rounds = 9;
    double seconds = 0;
    std::size_t error_pixels = 1000;
    std::optional<double> max_error;
    bool as_original = false, native = false, calibrate = false, keep_going = false, quiet = false;
};

void add_speed_options(CLI::App& command, SpeedOptions& options);

/// The devices that are named, or the default. @throws host::Failure, host::UsageError
std::vector<host::DeviceInfo> devices_of(const SpeedOptions& o);

/// @throws host::UsageError, host::Failure for a device without double
SpeedSettings settings_of(const SpeedOptions& o, const std::vector<host::DeviceInfo>& devices);

} // namespace clucida::bench
