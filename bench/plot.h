/// Plots as SVG: small, without scripts or fonts from elsewhere, to be read on light and dark, by the colour-blind too.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace clucida::bench {

/// What series of one name look like wherever they are drawn: a number for the colour and the marker.
class SeriesStyles {
public:
    /// The number of the name: as it was, or the next.
    unsigned of(const std::string& name);

private:
    std::vector<std::string> names_;
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
    std::string name;
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
    std::vector<std::string> series;
    std::vector<BarGroup> groups;
};

/// An <svg> element; a file of its own if it is standalone, else part of a page that has plot_style().
std::string svg_of(const Plot& plot, SeriesStyles& styles, bool is_standalone);
std::string svg_of(const BarPlot& plot, SeriesStyles& styles, bool is_standalone);

/// The style sheet of plots.
std::string plot_style();

/// Text for XML and HTML: with <, >, & and quotes escaped, and without control characters.
std::string xml_text(const std::string& text);

} // namespace clucida::bench
