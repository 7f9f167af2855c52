/// Plots of what was measured.
#pragma once

#include "bench/measure_speed.h"
#include "bench/plot.h"

#include <span>
#include <string>
#include <vector>

namespace clucida::bench {

struct NamedPlot {
    std::string name; ///< of a file, without its ending
    std::string svg;
};

enum class PlotUse : bool { page, file };

/// The front of speed and error of each scene and size, as far as errors are known.
std::vector<NamedPlot> front_plots(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use);

/// Devices, precisions and kernels beside each other, if there are several: the scenes' times over the fastest's.
std::vector<NamedPlot> device_plots(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use);

/// How time goes with threads, pixels, samples and hops, as far as contenders differ in them; geometric means over the
/// scenes.
std::vector<NamedPlot> scaling_plots(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use);

/// How time goes with the number of objects, over scenes that differ in nothing else.
NamedPlot objects_plot(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use);

/// All of them but that of objects.
std::vector<NamedPlot> speed_plots(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use);

} // namespace clucida::bench
