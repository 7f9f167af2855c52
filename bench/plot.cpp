#include "bench/plot.h"

#include "bench/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clucida::bench {
namespace {

constexpr unsigned color_count = 7, marker_count = 5;
constexpr double left = 78, top = 38, below = 54, legend = 290; ///< margins, and the legend's column
constexpr double area_width = 460, area_height = 300;
constexpr double bar_height = 11, bar_gap = 9, names_width = 128, label_width = 96;
constexpr double line_height = 19;

std::string color_class(unsigned style)
{
    return fmt::format("c{}", style % color_count);
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "")
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       xml_text(text));
}

std::string line_at(double x0, double y0, double x1, double y1, const char* what)
{
    return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", what, x0, y0,
                       x1, y1);
}

std::string marker_at(double x, double y, unsigned style, const std::string& note = "")
{
    const std::string title = note.empty() ? "" : "<title>" + xml_text(note) + "</title>";
    const std::string color = color_class(style);
    const auto path = [&](const char* shape) {
        return fmt::format("<path class=\"mark {}\" transform=\"translate({:.1f} {:.1f})\" d=\"{}\">{}</path>\n", color,
                           x, y, shape, title);
    };
    switch (style % marker_count) {
    case 1: return path("M-4 -4H4V4H-4Z");
    case 2: return path("M0 -5L5 4H-5Z");
    case 3: return path("M0 -5.5L5.5 0L0 5.5L-5.5 0Z");
    case 4: return path("M0 5L5 -4H-5Z");
    default: break;
    }
    return fmt::format("<circle class=\"mark {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\">{}</circle>\n", color, x, y,
                       title);
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

unsigned SeriesStyles::of(const std::string& name)
{
    const auto at = std::ranges::find(names_, name);
    if (at != names_.end()) return static_cast<unsigned>(at - names_.begin());
    names_.push_back(name);
    return static_cast<unsigned>(names_.size()) - 1;
}

std::string svg_of(const Plot& plot, SeriesStyles& styles, bool is_standalone)
{
    std::vector<double> x, y;
    for (const Series& s : plot.series)
        for (const PlotPoint& p : drawn(plot, s.points)) {
            x.push_back(p.x);
            y.push_back(p.y);
        }
    const Frame frame(plot, x, y);
    const double rows = static_cast<double>(plot.series.size()) + 2;
    const double height = std::max(top + area_height + below, top + rows * line_height);
    std::string out = opening(left + area_width + legend, height, plot.title, is_standalone) + frame.svg();
    const double key = left + area_width + 22;
    double row = top + 10;
    if (const std::vector<PlotPoint> front = drawn(plot, plot.front); front.size() > 1) {
        out += joined(frame, front, "front");
        out += line_at(key - 9, row - 4, key + 9, row - 4, "front");
        out += text_at(key + 16, row, "start", plot.front_name);
        row += line_height;
    }
    for (const Series& s : plot.series) {
        const unsigned style = styles.of(s.name);
        const std::vector<PlotPoint> points = drawn(plot, s.points);
        if (s.is_joined && points.size() > 1) out += joined(frame, points, "curve " + color_class(style));
        for (const PlotPoint& p : points) out += marker_at(frame.x(p.x), frame.y(p.y), style, p.note);
        out += marker_at(key, row - 4, style) + text_at(key + 16, row, "start", s.name);
        row += line_height;
    }
    return out + "</svg>\n";
}

std::string svg_of(const BarPlot& plot, SeriesStyles& styles, bool is_standalone)
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

    std::string out = opening(left + area_width + legend, bottom + below, plot.title, is_standalone);
    double row = top + 10;
    for (const std::string& name : plot.series) {
        out += fmt::format("<rect class=\"bar {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"{:.0f}\"/>\n",
                           color_class(styles.of(name)), begin, row - 10, bar_height - 1);
        out += text_at(begin + 22, row, "start", name);
        row += line_height;
    }
    double y = row;
    const double first = y - 4;
    for (const double t : range.ticks()) {
        out += line_at(place(t), first, place(t), bottom, "grid");
        out += text_at(place(t), bottom + 17, "middle", tick_text(t));
    }
    for (const BarGroup& g : plot.groups) {
        out += text_at(begin - 8, y + bars * bar_height / 2 + 4, "end", g.name);
        for (std::size_t i = 0; i < g.values.size(); ++i, y += bar_height) {
            const double length = g.values[i] ? place(*g.values[i]) - begin : 0;
            if (g.values[i])
                out += fmt::format("<rect class=\"bar {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                                   "height=\"{:.0f}\"/>\n",
                                   color_class(styles.of(plot.series[i])), begin, y, length, bar_height - 1);
            out += text_at(begin + length + 5, y + 9, "start", g.labels[i], " class=\"small\"");
        }
        y += bar_gap;
    }
    out += text_at(begin + width / 2, bottom + 40, "middle", plot.axis);
    return out + "</svg>\n";
}

std::string plot_style()
{
    // Okabe and Ito's colours, the yellow left out; the blue lighter on dark.
    return "svg.plot { font: 12px system-ui, sans-serif; max-width: 100%; height: auto }\n"
           "svg.plot text { fill: #1f2328 }\n"
           "svg.plot .title { font-size: 14px; font-weight: 600 }\n"
           "svg.plot .small { font-size: 9px }\n"
           "svg.plot .paper { fill: #ffffff }\n"
           "svg.plot .grid { stroke: #c8ced4; stroke-width: 1 }\n"
           "svg.plot .fine { stroke: #e6eaee; stroke-width: 1 }\n"
           "svg.plot .front { stroke: #6e7781; stroke-width: 1.5; stroke-dasharray: 5 4; fill: none }\n"
           "svg.plot .curve { stroke-width: 1.8; fill: none }\n"
           "svg.plot .mark { stroke: #ffffff; stroke-width: 1 }\n"
           "svg.plot .c0 { fill: #0072b2 } svg.plot .curve.c0 { fill: none; stroke: #0072b2 }\n"
           "svg.plot .c1 { fill: #d55e00 } svg.plot .curve.c1 { fill: none; stroke: #d55e00 }\n"
           "svg.plot .c2 { fill: #009e73 } svg.plot .curve.c2 { fill: none; stroke: #009e73 }\n"
           "svg.plot .c3 { fill: #cc79a7 } svg.plot .curve.c3 { fill: none; stroke: #cc79a7 }\n"
           "svg.plot .c4 { fill: #e69f00 } svg.plot .curve.c4 { fill: none; stroke: #e69f00 }\n"
           "svg.plot .c5 { fill: #56b4e9 } svg.plot .curve.c5 { fill: none; stroke: #56b4e9 }\n"
           "svg.plot .c6 { fill: #7f7f7f } svg.plot .curve.c6 { fill: none; stroke: #7f7f7f }\n"
           "@media (prefers-color-scheme: dark) {\n"
           "svg.plot text { fill: #e6edf3 }\n"
           "svg.plot .paper { fill: #15191f }\n"
           "svg.plot .mark { stroke: #15191f }\n"
           "svg.plot .grid { stroke: #3d444d }\n"
           "svg.plot .fine { stroke: #262c34 }\n"
           "svg.plot .front { stroke: #9198a1 }\n"
           "svg.plot .c0 { fill: #4ba3e3 } svg.plot .curve.c0 { fill: none; stroke: #4ba3e3 }\n"
           "}\n";
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
