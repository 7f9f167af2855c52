#include "bench/report_parts.h"

#include "bench/speed_axes.h"
#include "bench/speed_words.h"
#include "bench/sphere_field.h"
#include "host/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <thread>

namespace clucida::bench {
namespace {

using host::Precision;
using Kernels = std::vector<std::optional<host::KernelShape>>;

constexpr std::size_t few_scenes = 3;
constexpr std::size_t most_failures = 2; ///< of a contender, one scene after the other

std::vector<Precision> precisions_of(const host::DeviceInfo& device)
{
    std::vector<Precision> out{Precision::single};
    if (device.has_double) out.push_back(Precision::twofold);
    return out;
}

/// The one that it takes by itself; beside packets, pixels.
Kernels kernels_of(const host::DeviceInfo& device)
{
    if (host::kernel_shape(device, 1) == host::KernelShape::pixels) return {std::nullopt};
    return {std::nullopt, host::KernelShape::pixels};
}

/// Of all scenes a few, from all over the list.
std::vector<std::string> few_of(const ReportPlan& plan)
{
    const std::size_t count = std::min(plan.quick ? 1 : few_scenes, plan.scenes.size());
    std::vector<std::string> out;
    for (std::size_t i = 0; i < count; ++i) out.push_back(plan.scenes[i * plan.scenes.size() / count]);
    return out;
}

/// What all parts have in common: short turns, a limit of time for each contender, rows for those that fail.
SpeedSettings base_settings(const ReportPlan& plan)
{
    const host::DeviceInfo& device = plan.devices.front();
    SpeedSettings out;
    out.rounds = plan.quick ? 3 : 7;
    out.least_turn = plan.quick ? 0.01 : 0.03;
    out.most_seconds = plan.quick ? 0.2 : 1;
    out.most_opening = 300; // what hangs would else keep the report from its end
    out.keep_going = true;
    out.error_pixels = plan.quick ? 50 : 400;
    out.oracle_threads = std::max(std::thread::hardware_concurrency(), 1U);
    out.reference_device = host::place(device);
    out.reference_precision = device.has_double ? Precision::twofold : Precision::single;
    return out;
}

/// The axes of the first device in float, for a start.
SpeedAxes base_axes(const ReportPlan& plan)
{
    SpeedAxes out;
    out.devices = {plan.devices.front()};
    out.pictures = {plan.picture};
    return out;
}

ReportPart devices_part(const ReportPlan& plan)
{
    ReportPart out{
        "devices",
        "Devices, precisions and kernels",
        "Each scene on every device: in float with each kernel, in double with the one that it takes by itself.",
        PartPlots::devices,
        base_settings(plan),
        plan.scenes};
    for (const host::DeviceInfo& device : plan.devices) {
        SpeedAxes axes = base_axes(plan);
        axes.devices = {device};
        axes.kernels = kernels_of(device);
        for (SpeedContender& c : contenders_of(axes)) out.settings.contenders.push_back(std::move(c));
        if (!device.has_double) continue;
        axes.precisions = {Precision::twofold};
        axes.kernels = {std::nullopt}; // compiling takes most of the time
        for (SpeedContender& c : contenders_of(axes)) out.settings.contenders.push_back(std::move(c));
    }
    return out;
}

ReportPart fronts_part(const ReportPlan& plan)
{
    ReportPart out{
        "settings",
        "Settings: time and error",
        "What samples and precision cost and gain on each device; on the first hops and cutoff, too. A point of the "
        "front is one that no other betters in both time and error.",
        PartPlots::fronts,
        base_settings(plan),
        plan.scenes};
    SpeedAxes axes = base_axes(plan);
    axes.samples = plan.quick ? std::vector{1U, 4U} : std::vector{1U, 4U, 16U};
    axes.max_hops = {std::nullopt, 4U};
    axes.cutoffs = {std::nullopt, 0.05};
    for (const host::DeviceInfo& device : plan.devices) {
        axes.devices = {device};
        axes.precisions = precisions_of(device);
        for (SpeedContender& c : contenders_of(axes)) out.settings.contenders.push_back(std::move(c));
        axes.max_hops = {std::nullopt};
        axes.cutoffs = {std::nullopt};
    }
    out.settings.error = ErrorFrom::none;
    out.settings.settings_error = true;
    out.settings.rounds = plan.quick ? 3 : 5; // many contenders, some of seconds
    out.settings.most_seconds = plan.quick ? 0.2 : 0.5;
    return out;
}

ReportPart threads_part(const ReportPlan& plan)
{
    ReportPart out{
        "threads",          "Scaling with threads", "A few scenes on the first device, with limits of its threads.",
        PartPlots::scaling, base_settings(plan),    few_of(plan)};
    SpeedAxes axes = base_axes(plan);
    axes.threads.clear();
    const unsigned all = std::max(plan.devices.front().compute_units, 1U);
    for (unsigned threads = 1; threads < all; threads *= 2) axes.threads.push_back(threads);
    axes.threads.push_back(all);
    out.settings.contenders = contenders_of(axes);
    return out;
}

ReportPart sizes_part(const ReportPlan& plan)
{
    ReportPart out{"sizes",
                   "Scaling with the picture's size",
                   "A few scenes on the first device, in pictures of several sizes.",
                   PartPlots::scaling,
                   base_settings(plan),
                   few_of(plan)};
    SpeedAxes axes = base_axes(plan);
    const auto [width, height] = plan.picture;
    axes.pictures = {{std::max(width / 2, 1U), std::max(height / 2, 1U)}, plan.picture, {2 * width, 2 * height}};
    if (!plan.quick) axes.pictures.push_back({4 * width, 4 * height});
    out.settings.contenders = contenders_of(axes);
    return out;
}

ReportPart rays_part(const ReportPlan& plan)
{
    ReportPart out{
        "rays",
        "Scaling with samples and hops",
        "A few scenes on the first device: how time goes with the samples of a pixel, and with the hops that "
        "a ray may take.",
        PartPlots::scaling,
        base_settings(plan),
        few_of(plan)};
    SpeedAxes axes = base_axes(plan);
    axes.max_hops = {std::nullopt, 1U, 2U, 4U, 8U, 16U};
    out.settings.contenders = contenders_of(axes);
    axes.max_hops = {std::nullopt};
    axes.samples = plan.quick ? std::vector{2U, 4U} : std::vector{2U, 4U, 8U, 16U};
    for (SpeedContender& c : contenders_of(axes)) out.settings.contenders.push_back(std::move(c));
    out.settings.error = ErrorFrom::none;
    out.settings.settings_error = true;
    return out;
}

ReportPart objects_part(const ReportPlan& plan, const std::filesystem::path& folder)
{
    ReportPart out{"objects",
                   "Scaling with objects",
                   "Spheres at random in a block, half of glass; the more there are the smaller they are, so that they "
                   "cover always about as much of the picture.",
                   PartPlots::objects,
                   base_settings(plan),
                   {}};
    SpeedAxes axes = base_axes(plan);
    if (!plan.quick) axes.kernels = kernels_of(plan.devices.front());
    out.settings.contenders = contenders_of(axes);
    const unsigned most = plan.quick ? 512 : 16384, factor = plan.quick ? 8 : 4;
    for (unsigned count = 64; count <= most; count *= factor) {
        const std::filesystem::path file = folder / fmt::format("spheres{}.clu", count);
        host::write_file(file, sphere_field(count));
        out.scenes.push_back(file.string());
    }
    return out;
}

bool is_hopeless(const ReportPart& part, const SpeedContender& c)
{
    if (part.results.size() < most_failures) return false;
    return std::ranges::all_of(std::span(part.results).last(most_failures), [&](const SceneSpeed& scene) {
        const auto at = std::ranges::find(scene.reports, c, &SpeedReport::contender);
        return at != scene.reports.end() && !at->failure.empty();
    });
}

} // namespace

std::vector<ReportPart> report_parts(const ReportPlan& plan, const std::filesystem::path& folder)
{
    std::vector<ReportPart> out{devices_part(plan), fronts_part(plan)};
    const host::DeviceInfo& device = plan.devices.front();
    const bool has_limits = device.kind == host::DeviceKind::cpu && !device.native; // the native device takes all
    if (has_limits && device.compute_units > 1) out.push_back(threads_part(plan));
    out.push_back(sizes_part(plan));
    out.push_back(rays_part(plan));
    out.push_back(objects_part(plan, folder));
    return out;
}

void leave_out_hopeless(ReportPart& part)
{
    const auto hopeless = [&](const SpeedContender& c) { return is_hopeless(part, c); };
    std::vector<std::string> names;
    for (const SpeedContender& c : part.settings.contenders)
        if (hopeless(c)) names.push_back(fmt::format("{} ({})", describe(c), kernel_name(c.kernel)));
    if (names.empty()) return;
    part.what += fmt::format(" Failed on {} scenes running, and left out from the next: {}.", most_failures,
                             fmt::join(names, "; "));
    std::erase_if(part.settings.contenders, hopeless);
}

std::vector<NamedPlot> plots_of(const ReportPart& part, DeviceColors& colors, PlotUse use)
{
    switch (part.plots) {
    case PartPlots::devices: return device_plots(part.results, colors, use);
    case PartPlots::fronts: return front_plots(part.results, colors, use);
    case PartPlots::scaling: return scaling_plots(part.results, colors, use);
    case PartPlots::objects: break;
    }
    return {objects_plot(part.results, colors, use)};
}

} // namespace clucida::bench
