/// Plots as SVG: small, without scripts or fonts from elsewhere, to be read on light and dark, by the colour-blind too.
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace clucida::bench {

/// What a series is of: a device, and how it was used.
struct SeriesName {
    std::string device, setting = {};
    bool operator==(const SeriesName&) const = default;
    bool operator<(const SeriesName& b) const { return std::tie(device, setting) < std::tie(b.device, b.setting); }
};

/// A device has the same colour in all plots. Within a plot a series' setting, by its place among those of the plot,
/// tells its markers, its dashes and how full its bars are.
class DeviceColors {
public:
    /// The colour's number: as it was, or the next.
    unsigned of(const std::string& device);

private:
    std::vector<std::string> devices_;
};

enum class Scale { linear, logarithmic };

struct Axis {
    std::string label; ///< with its unit
    Scale scale = Scale::linear;
};

struct PlotPoint {
    double x = 0, y = 0;   ///< above 0 on a logarithmic axis; what is not is left out
    std::string note = {}; ///< shown beneath the pointer
};

struct Series {
    SeriesName name;
    std::vector<PlotPoint> points;
    bool is_joined = true; ///< by lines, in their order
};

/// Points over two axes.
struct Plot {
    std::string title;
    Axis x, y;
    std::vector<Series> series;
    std::vector<PlotPoint> front = {}; ///< joined by a dashed line, if there are two
    std::string front_name = {};
};

struct BarGroup {
    std::string name;
    std::vector<std::optional<double>> values; ///< one of each series, not below 0
    std::vector<std::string> labels;           ///< at the bars' ends, likewise
};

/// Horizontal bars from 0, in groups.
struct BarPlot {
    std::string title;
    std::string axis; ///< with its unit
    std::vector<SeriesName> series;
    std::vector<BarGroup> groups;
};

/// An <svg> element; a file of its own if it is standalone, else part of a page that has plot_style().
std::string svg_of(const Plot& plot, DeviceColors& colors, bool is_standalone);
std::string svg_of(const BarPlot& plot, DeviceColors& colors, bool is_standalone);

/// The style sheet of plots.
std::string plot_style();

/// Text for XML and HTML: with <, >, & and quotes escaped, and without control characters.
std::string xml_text(const std::string& text);

} // namespace clucida::bench
