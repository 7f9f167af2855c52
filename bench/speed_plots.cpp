#include "bench/speed_plots.h"

#include "bench/median.h"
#include "bench/precision_name.h"
#include "bench/speed_rank.h"
#include "bench/speed_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace clucida::bench {
namespace {

bool was_measured(const SpeedReport& r)
{
    return r.failure.empty() && !r.real.empty();
}

SeriesName series_name(const SpeedReport& r)
{
    const std::string precision = precision_name(r.contender.precision);
    const auto& kernel = r.contender.kernel;
    return {device_name(r), kernel ? fmt::format("{} {}", precision, kernel_name(kernel)) : precision};
}

/// "gems.clu" as a part of a file's name: "gems-clu".
std::string file_part(const std::string& text)
{
    std::string out = text;
    for (char& c : out)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    return out;
}

/// The series of that name, added if there is none.
Series& series_of(std::vector<Series>& all, const SeriesName& name, bool is_joined)
{
    const auto at = std::ranges::find(all, name, &Series::name);
    if (at != all.end()) return *at;
    return all.emplace_back(Series{name, {}, is_joined});
}

std::string note_of(const SpeedReport& r, double error)
{
    const SpeedContender& c = r.contender;
    const SeriesName name = series_name(r);
    return fmt::format("{} {}, {} samples, hops {}, cutoff {}{}: {:.3g} ms, RMSE {:.1e}", name.device, name.setting,
                       c.view.samples, hops_name(c.view), cutoff_name(c.view),
                       c.threads ? fmt::format(", {} threads", c.threads) : "", 1e3 * median(r.real), error);
}

/// One of the axes that contenders may differ in.
struct ScalingAxis {
    const char* name;
    const char* title;
    Axis x, y;
    double (*value)(const SpeedReport&); ///< 0: not on the axis
    void (*reset)(SpeedContender&);      ///< makes contenders equal that differ on this axis only
    double (*figure)(double seconds, double first, const SpeedReport&); ///< first: s at the least value
};

double times(double seconds, double first, const SpeedReport&)
{
    return seconds / first;
}

const ScalingAxis scaling_axes[] = {
    {"threads",
     "Speed with threads",
     {"threads", Scale::logarithmic},
     {"speed over that with the fewest threads", Scale::logarithmic},
     [](const SpeedReport& r) { return static_cast<double>(r.threads); },
     [](SpeedContender& c) { c.threads = 0; },
     [](double seconds, double first, const SpeedReport&) { return first / seconds; }},
    {"pixels",
     "Time a pixel with the picture's size",
     {"pixels", Scale::logarithmic},
     {"time a pixel, ns", Scale::logarithmic},
     [](const SpeedReport& r) { return static_cast<double>(host::area(r.contender.view.picture)); },
     [](SpeedContender& c) { c.view.picture = {}; },
     [](double seconds, double, const SpeedReport& r) {
         return 1e9 * seconds / static_cast<double>(host::area(r.contender.view.picture));
     }},
    {"samples",
     "Time with samples",
     {"samples a pixel", Scale::logarithmic},
     {"time over that with the fewest samples", Scale::logarithmic},
     [](const SpeedReport& r) { return static_cast<double>(r.contender.view.samples); },
     [](SpeedContender& c) { c.view.samples = 1; },
     times},
    {"hops",
     "Time with hops",
     {"hops allowed", Scale::logarithmic},
     {"time over that with the fewest hops", Scale::linear},
     [](const SpeedReport& r) { return static_cast<double>(r.contender.view.max_hops.value_or(0)); },
     [](SpeedContender& c) { c.view.max_hops = {}; },
     times},
};

using Curve = std::map<double, const SpeedReport*>;

/// Of each series the scenes' curves along the axis. All else is as of the first contender, but for device, precision
/// and kernel.
std::map<SeriesName, std::vector<Curve>> curves_along(const ScalingAxis& axis, std::span<const SceneSpeed> results)
{
    std::map<SeriesName, std::vector<Curve>> out;
    for (const SceneSpeed& scene : results) {
        std::map<SeriesName, Curve> curves;
        for (const SpeedReport& r : scene.reports) {
            if (!was_measured(r) || axis.value(r) <= 0) continue;
            SpeedContender c = r.contender, base = scene.reports.front().contender;
            axis.reset(c);
            axis.reset(base);
            base.device = c.device;
            base.precision = c.precision;
            base.kernel = c.kernel;
            if (c == base) curves[series_name(r)].emplace(axis.value(r), &r);
        }
        for (auto& [name, curve] : curves)
            if (curve.size() > 1) out[name].push_back(std::move(curve));
    }
    return out;
}

/// The geometric mean over the scenes, at the values that all have.
std::vector<PlotPoint> mean_curve(const ScalingAxis& axis, const std::vector<Curve>& curves)
{
    std::map<double, std::pair<double, std::size_t>> sums;
    for (const Curve& curve : curves) {
        const double first = median(curve.begin()->second->real);
        for (const auto& [x, r] : curve) {
            auto& [sum, count] = sums[x];
            sum += std::log(axis.figure(median(r->real), first, *r));
            ++count;
        }
    }
    std::vector<PlotPoint> out;
    for (const auto& [x, sum] : sums)
        if (sum.second == curves.size()) out.push_back({x, std::exp(sum.first / static_cast<double>(sum.second))});
    return out;
}

} // namespace

std::vector<NamedPlot> front_plots(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use)
{
    std::vector<NamedPlot> out;
    for (const SceneSpeed& scene : results) {
        std::map<std::string, Plot> by_size;
        for (const Ranked& r : ranked(scene)) {
            const std::optional<double> error = judged_error(*r.report);
            if (!error) continue;
            const std::string size = size_name(r.report->contender.view.picture);
            Plot& plot = by_size[size];
            plot.title = fmt::format("{}, {}: time and error", scene.name, size);
            plot.x = {"time of a picture, ms", Scale::logarithmic};
            plot.y = {"RMSE, linear light", Scale::logarithmic};
            const PlotPoint p{1e3 * median(r.report->real), *error, note_of(*r.report, *error)};
            series_of(plot.series, series_name(*r.report), false).points.push_back(p);
            if (r.on_front) plot.front.push_back(p);
            plot.front_name = "front: none is better in both";
        }
        for (const auto& [size, plot] : by_size)
            out.push_back(
                {fmt::format("front-{}-{}", file_part(scene.name), size), svg_of(plot, colors, use == PlotUse::file)});
    }
    return out;
}

std::vector<NamedPlot> device_plots(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use)
{
    BarPlot plot{"Devices, precisions and kernels: time over the fastest's", "time over the scene's fastest", {}, {}};
    std::vector<std::vector<const SpeedReport*>> rows;
    for (const SceneSpeed& scene : results) {
        std::vector<const SpeedReport*>& row = rows.emplace_back();
        for (const SpeedReport& r : scene.reports) {
            const SpeedContender& first = scene.reports.front().contender;
            if (!was_measured(r) || r.contender.view != first.view || r.contender.threads != first.threads ||
                r.contender.group != first.group)
                continue;
            row.push_back(&r);
            if (std::ranges::find(plot.series, series_name(r)) == plot.series.end())
                plot.series.push_back(series_name(r));
        }
    }
    if (plot.series.size() < 2) return {};
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (rows[i].empty()) continue;
        const auto time = [](const SpeedReport* r) { return median(r->real); };
        const double fastest = time(*std::ranges::min_element(rows[i], {}, time));
        BarGroup group{results[i].name, std::vector<std::optional<double>>(plot.series.size()),
                       std::vector<std::string>(plot.series.size(), "-")};
        for (const SpeedReport* r : rows[i]) {
            const auto at = std::ranges::find(plot.series, series_name(*r)) - plot.series.begin();
            group.values[static_cast<std::size_t>(at)] = time(r) / fastest;
            group.labels[static_cast<std::size_t>(at)] = fmt::format("{:.2f} ms", 1e3 * time(r));
        }
        plot.groups.push_back(std::move(group));
    }
    return {{"devices", svg_of(plot, colors, use == PlotUse::file)}};
}

std::vector<NamedPlot> scaling_plots(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use)
{
    std::vector<NamedPlot> out;
    for (const ScalingAxis& axis : scaling_axes) {
        Plot plot{axis.title, axis.x, axis.y, {}};
        for (const auto& [name, curves] : curves_along(axis, results)) {
            Series s{name, mean_curve(axis, curves)};
            if (s.points.size() > 1) plot.series.push_back(std::move(s));
        }
        if (!plot.series.empty())
            out.push_back({std::string("with-") + axis.name, svg_of(plot, colors, use == PlotUse::file)});
    }
    return out;
}

NamedPlot objects_plot(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use)
{
    Plot plot{"Time a pixel with the number of objects",
              {"objects", Scale::logarithmic},
              {"time a pixel, ns", Scale::logarithmic},
              {}};
    for (const SceneSpeed& scene : results)
        for (const SpeedReport& r : scene.reports)
            if (was_measured(r))
                series_of(plot.series, series_name(r), true)
                    .points.push_back({static_cast<double>(r.objects),
                                       1e9 * median(r.real) / static_cast<double>(host::area(r.contender.view.picture)),
                                       scene.name});
    return {"with-objects", svg_of(plot, colors, use == PlotUse::file)};
}

std::vector<NamedPlot> speed_plots(std::span<const SceneSpeed> results, DeviceColors& colors, PlotUse use)
{
    std::vector<NamedPlot> out = device_plots(results, colors, use);
    for (auto* const plots : {front_plots, scaling_plots})
        for (NamedPlot& plot : plots(results, colors, use)) out.push_back(std::move(plot));
    return out;
}

} // namespace clucida::bench
