/// What a report measures: parts, each a race with contenders of its own.
#pragma once

#include "bench/measure_speed.h"
#include "bench/speed_plots.h"
#include "host/device_choice.h"

#include <filesystem>
#include <string>
#include <vector>

namespace clucida::bench {

struct ReportPlan {
    std::vector<std::string> scenes;       ///< files
    std::vector<host::DeviceInfo> devices; ///< one at least; the first is the one that is looked at closely
    host::Shape picture{160, 90};
    bool quick = false; ///< few values and rounds, to see that it works
};

/// Plots that a part is shown by.
enum class PartPlots { devices, fronts, scaling, objects };

struct ReportPart {
    std::string name; ///< what benchmarks' names begin with
    std::string title, what;
    PartPlots plots = PartPlots::devices;
    SpeedSettings settings;
    std::vector<std::string> scenes;      ///< files
    std::vector<SceneSpeed> results = {}; ///< of each scene, once they are measured
};

/// Devices beside each other; settings of all devices, for fronts and calibrations; threads, picture's sizes, samples
/// and hops of the first device on a few scenes; fields of spheres, which are written into `folder`. @throws
/// host::Failure
std::vector<ReportPart> report_parts(const ReportPlan& plan, const std::filesystem::path& folder);

/// Takes those contenders out of the part that failed on its last two scenes, and says so in `what`: a device that
/// cannot compile the kernels may take minutes to tell.
void leave_out_hopeless(ReportPart& part);

std::vector<NamedPlot> plots_of(const ReportPart& part, DeviceColors& colors, PlotUse use);

} // namespace clucida::bench
