#include "bench/plot.h"

#include "bench/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>

namespace clucida::bench {
namespace {

constexpr double left = 78, top = 38, below = 54, legend = 290; ///< margins, and the legend's column
constexpr double area_width = 460, area_height = 300;
constexpr double bar_height = 11, bar_gap = 9, names_width = 128, label_width = 96;
constexpr double line_height = 19;
constexpr double letter_width = 6.6; ///< of most fonts' letters at 12 px, on the average

struct SeriesColor {
    const char *on_light, *on_dark;
};

/// Each at 3:1 or more from its paper, and as far from one another as they get for those who see red or green badly too
/// (distances in Oklab, as seen by Machado, Oliveira and Fernandes 2009).
constexpr SeriesColor palette[] = {
    {"#4e8bd2", "#ace0fd"}, // blue
    {"#e07717", "#f38a39"}, // orange
    {"#208e79", "#83eea4"}, // green
    {"#8a0082", "#c661a3"}, // purple
    {"#806911", "#f1cc0b"}, // ochre, yellow
    {"#6f43de", "#6f67fc"}, // violet
    {"#4c4546", "#b5adb0"}, // grey
    {"#950100", "#eb3624"}, // red
    {"#366d76", "#24c6ef"}, // petrol
    {"#70a064", "#70825c"}  // leaf, moss
};

/// How settings are told apart.
struct Shape {
    const char* marker; ///< a path about 0 0
    const char* dashes; ///< of lines
    double fullness;    ///< of bars, 0..1
};
constexpr Shape shapes[] = {{"M-4.5 0A4.5 4.5 0 1 1 4.5 0A4.5 4.5 0 1 1 -4.5 0Z", "none", 1},
                            {"M-4 -4H4V4H-4Z", "7 3", 0.6},
                            {"M0 -5L5 4H-5Z", "2 3", 0.3},
                            {"M0 -5.5L5.5 0L0 5.5L-5.5 0Z", "9 3 2 3", 0.05},
                            {"M0 5L5 -4H-5Z", "14 4", 0.8},
                            {"M-5 -1.7H-1.7V-5H1.7V-1.7H5V1.7H1.7V5H-1.7V1.7H-5Z", "5 2 1 2 1 2", 0.45}};

struct SeriesStyle {
    unsigned color = 0, shape = 0;
};

std::vector<SeriesStyle> styles_of(const std::vector<SeriesName>& names, DeviceColors& colors)
{
    std::set<std::string, std::greater<>> settings; // float before double
    for (const SeriesName& name : names) settings.insert(name.setting);
    std::vector<SeriesStyle> out;
    out.reserve(names.size());
    for (const SeriesName& name : names)
        out.push_back({colors.of(name.device),
                       static_cast<unsigned>(std::distance(settings.begin(), settings.find(name.setting)))});
    return out;
}

std::string style_class(const SeriesStyle& style)
{
    return fmt::format("c{} s{}", style.color % std::size(palette), style.shape % std::size(shapes));
}

std::string words_of(const SeriesName& name)
{
    return name.setting.empty() ? name.device : name.device + " " + name.setting;
}

/// With its middle left out if it is wider.
std::string fitted(const std::string& text, double width)
{
    const auto most = static_cast<std::size_t>(width / letter_width);
    if (text.size() <= most) return text;
    const std::size_t end = (most - 3) / 2;
    return text.substr(0, most - 3 - end) + "..." + text.substr(text.size() - end);
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "")
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       xml_text(text));
}

std::string line_at(double x0, double y0, double x1, double y1, const std::string& what)
{
    return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", what, x0, y0,
                       x1, y1);
}

std::string marker_at(double x, double y, const SeriesStyle& style, const std::string& note = "")
{
    return fmt::format("<path class=\"mark {}\" transform=\"translate({:.1f} {:.1f})\" d=\"{}\">{}</path>\n",
                       style_class(style), x, y, shapes[style.shape % std::size(shapes)].marker,
                       note.empty() ? "" : "<title>" + xml_text(note) + "</title>");
}

std::string bar_at(double x, double y, double width, const SeriesStyle& style)
{
    return fmt::format("<rect class=\"bar {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.0f}\"/>\n",
                       style_class(style), x, y, width, bar_height - 2);
}

std::string opening(double width, double height, const std::string& title, bool is_standalone)
{
    std::string out =
        fmt::format("<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" "
                    "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\">\n<title>{2}</title>\n",
                    width, height, xml_text(title));
    if (is_standalone) out += "<style>\n" + plot_style() + "</style>\n";
    out += fmt::format("<rect class=\"paper\" width=\"{:.0f}\" height=\"{:.0f}\"/>\n", width, height);
    return out + text_at(left, 22, "start", title, " class=\"title\"");
}

/// The frame of points: axes with ticks, and where a point lies.
class Frame {
public:
    Frame(const Plot& plot, const std::vector<double>& x, const std::vector<double>& y)
        : plot_(plot), x_(plot.x.scale, x), y_(plot.y.scale, y)
    {
    }
    double x(double value) const { return left + area_width * x_.place(value); }
    double y(double value) const { return top + area_height * (1 - y_.place(value)); }

    std::string svg() const
    {
        constexpr double bottom = top + area_height, right = left + area_width;
        std::string out;
        for (const double t : x_.fine_ticks()) out += line_at(x(t), top, x(t), bottom, "fine");
        for (const double t : y_.fine_ticks()) out += line_at(left, y(t), right, y(t), "fine");
        for (const double t : x_.ticks()) {
            out += line_at(x(t), top, x(t), bottom, "grid");
            out += text_at(x(t), bottom + 17, "middle", tick_text(t));
        }
        for (const double t : y_.ticks()) {
            out += line_at(left, y(t), right, y(t), "grid");
            out += text_at(left - 8, y(t) + 4, "end", tick_text(t));
        }
        out += text_at(left + area_width / 2, bottom + 40, "middle", plot_.x.label);
        out += text_at(0, 0, "middle", plot_.y.label,
                       fmt::format(" transform=\"translate(18 {:.1f}) rotate(-90)\"", top + area_height / 2));
        return out;
    }

private:
    const Plot& plot_;
    AxisRange x_, y_;
};

bool is_drawn(const Plot& plot, const PlotPoint& p)
{
    const auto fits = [](Scale scale, double v) { return std::isfinite(v) && (scale == Scale::linear || v > 0); };
    return fits(plot.x.scale, p.x) && fits(plot.y.scale, p.y);
}

std::vector<PlotPoint> drawn(const Plot& plot, const std::vector<PlotPoint>& points)
{
    std::vector<PlotPoint> out;
    for (const PlotPoint& p : points)
        if (is_drawn(plot, p)) out.push_back(p);
    return out;
}

std::string joined(const Frame& frame, const std::vector<PlotPoint>& points, const std::string& what)
{
    std::string out;
    for (const PlotPoint& p : points)
        out += fmt::format("{}{:.1f},{:.1f}", out.empty() ? "" : " ", frame.x(p.x), frame.y(p.y));
    return fmt::format("<polyline class=\"{}\" points=\"{}\"/>\n", what, out);
}

} // namespace

unsigned DeviceColors::of(const std::string& device)
{
    const auto at = std::ranges::find(devices_, device) - devices_.begin();
    if (static_cast<std::size_t>(at) == devices_.size()) devices_.push_back(device);
    return static_cast<unsigned>(at);
}

std::string svg_of(const Plot& plot, DeviceColors& colors, bool is_standalone)
{
    std::vector<double> x, y;
    std::vector<SeriesName> names;
    for (const Series& s : plot.series) {
        names.push_back(s.name);
        for (const PlotPoint& p : drawn(plot, s.points)) {
            x.push_back(p.x);
            y.push_back(p.y);
        }
    }
    const std::vector<SeriesStyle> styles = styles_of(names, colors);
    const Frame frame(plot, x, y);
    const double rows = static_cast<double>(plot.series.size()) + 2;
    const double height = std::max(top + area_height + below, top + rows * line_height);
    std::string out = opening(left + area_width + legend, height, plot.title, is_standalone) + frame.svg();
    const double key = left + area_width + 28, key_text = key + 20;
    double row = top + 10;
    if (const std::vector<PlotPoint> front = drawn(plot, plot.front); front.size() > 1) {
        out += joined(frame, front, "front");
        out += line_at(key - 14, row - 4, key + 14, row - 4, "front");
        out += text_at(key_text, row, "start", plot.front_name);
        row += line_height;
    }
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const Series& s = plot.series[i];
        const SeriesStyle& style = styles[i];
        const std::string curve = "curve " + style_class(style);
        const std::vector<PlotPoint> points = drawn(plot, s.points);
        if (s.is_joined && points.size() > 1) out += joined(frame, points, curve);
        for (const PlotPoint& p : points) out += marker_at(frame.x(p.x), frame.y(p.y), style, p.note);
        if (s.is_joined) out += line_at(key - 14, row - 4, key + 14, row - 4, curve);
        out += marker_at(key, row - 4, style);
        out += text_at(key_text, row, "start", fitted(words_of(s.name), left + area_width + legend - key_text));
        row += line_height;
    }
    return out + "</svg>\n";
}

std::string svg_of(const BarPlot& plot, DeviceColors& colors, bool is_standalone)
{
    const auto bars = static_cast<double>(plot.series.size());
    const double group_height = bars * bar_height + bar_gap;
    const double bottom = top + line_height * bars + 8 + group_height * static_cast<double>(plot.groups.size());
    std::vector<double> values{0};
    for (const BarGroup& g : plot.groups)
        for (const auto& value : g.values)
            if (value) values.push_back(*value);
    const AxisRange range(Scale::linear, values);
    const double begin = left + names_width - 60, width = area_width + legend - names_width - label_width + 40;
    const auto place = [&](double value) { return begin + width * range.place(value); };

    const std::vector<SeriesStyle> styles = styles_of(plot.series, colors);
    std::string out = opening(left + area_width + legend, bottom + below, plot.title, is_standalone);
    double row = top + 10;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        out += bar_at(begin, row - 9, 18, styles[i]);
        out += text_at(begin + 26, row, "start", words_of(plot.series[i]));
        row += line_height;
    }
    double y = row;
    const double first = y - 4;
    for (const double t : range.ticks()) {
        out += line_at(place(t), first, place(t), bottom, "grid");
        out += text_at(place(t), bottom + 17, "middle", tick_text(t));
    }
    for (const BarGroup& g : plot.groups) {
        out += text_at(begin - 8, y + bars * bar_height / 2 + 4, "end", fitted(g.name, begin - 16));
        for (std::size_t i = 0; i < g.values.size(); ++i, y += bar_height) {
            const double length = g.values[i] ? place(*g.values[i]) - begin : 0;
            if (g.values[i]) out += bar_at(begin, y + 1, length, styles[i]);
            out += text_at(begin + length + 5, y + 9, "start", g.labels[i], " class=\"small\"");
        }
        y += bar_gap;
    }
    out += text_at(begin + width / 2, bottom + 40, "middle", plot.axis);
    return out + "</svg>\n";
}

std::string plot_style()
{
    std::string out = "svg.plot { font: 12px system-ui, sans-serif; max-width: 100%; height: auto }\n"
                      "svg.plot text { fill: #1f2328 }\n"
                      "svg.plot .title { font-size: 14px; font-weight: 600 }\n"
                      "svg.plot .small { font-size: 9px }\n"
                      "svg.plot .paper { fill: #ffffff }\n"
                      "svg.plot .grid { stroke: #c8ced4; stroke-width: 1 }\n"
                      "svg.plot .fine { stroke: #e6eaee; stroke-width: 1 }\n"
                      "svg.plot .front { stroke: #6e7781; stroke-width: 1.5; stroke-dasharray: 5 4; fill: none }\n";
    for (std::size_t i = 0; i < std::size(palette); ++i)
        out += fmt::format("svg.plot .c{0} {{ fill: {1}; stroke: {1} }}\n", i, palette[i].on_light);
    out += "svg.plot .curve { stroke-width: 1.8; fill: none }\n"
           "svg.plot .mark { stroke: #ffffff; stroke-width: 1 }\n"
           "svg.plot .bar { stroke-width: 1 }\n";
    for (std::size_t i = 0; i < std::size(shapes); ++i)
        out +=
            fmt::format("svg.plot .curve.s{0} {{ stroke-dasharray: {1} }} svg.plot .bar.s{0} {{ fill-opacity: {2} }}\n",
                        i, shapes[i].dashes, shapes[i].fullness);
    out += "@media (prefers-color-scheme: dark) {\n"
           "svg.plot text { fill: #e6edf3 }\n"
           "svg.plot .paper { fill: #15191f }\n"
           "svg.plot .grid { stroke: #3d444d }\n"
           "svg.plot .fine { stroke: #262c34 }\n"
           "svg.plot .front { stroke: #9198a1 }\n";
    for (std::size_t i = 0; i < std::size(palette); ++i)
        out += fmt::format("svg.plot .c{0} {{ fill: {1}; stroke: {1} }}\n", i, palette[i].on_dark);
    return out + "svg.plot .curve { fill: none }\nsvg.plot .mark { stroke: #15191f }\n}\n";
}

std::string xml_text(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '&': out += "&amp;"; break;
        case '"': out += "&quot;"; break;
        default:
            if (static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t') out += c;
        }
    }
    return out;
}

} // namespace clucida::bench
