#include "bench/commands.h"
#include "bench/report_files.h"
#include "bench/speed_axes.h"
#include "bench/speed_calibration.h"
#include "bench/speed_files.h"
#include "bench/speed_options.h"
#include "bench/temporary_folder.h"
#include "host/arguments.h"
#include "host/devices.h"
#include "host/errors.h"
#include "host/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

namespace clucida::bench {
namespace {

struct ReportOptions {
    std::vector<std::string> scenes, devices;
    std::string folder = "report", size, allow_path;
    bool quick = false, no_calibrate = false, quiet = false;
};

/// The scenes in the folder "scenes", by their names.
std::vector<std::string> scenes_here()
{
    constexpr std::array endings{".clu", ".gun", ".rayt"};
    std::vector<std::string> out;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("scenes", error))
        if (std::ranges::find(endings, entry.path().extension().string()) != endings.end())
            out.push_back(entry.path().string());
    if (out.empty()) throw host::UsageError("no scene is given, and there is none in the folder 'scenes' either");
    std::ranges::sort(out);
    return out;
}

/// Those that are named, else all that are usable, the default first.
std::vector<host::DeviceInfo> devices_of(const ReportOptions& o)
{
    SpeedOptions named;
    named.devices = o.devices;
    std::vector<host::DeviceInfo> out = devices_of(named);
    if (!o.devices.empty()) return out;
    for (const host::DeviceInfo& d : host::infos(host::list_devices()))
        if (d.usable && host::place(d) != host::place(out.front())) out.push_back(d);
    return out;
}

/// What is wrong with a scene is told before any work.
void require_readable(const ReportPlan& plan, const std::string& allow_path)
{
    for (const std::string& file : plan.scenes) {
        const host::SceneSource source = host::load_scene({file, "", allow_path});
        host::compile_scene(source, view_of(SpeedView{plan.picture}));
    }
}

ReportPlan plan_of(const ReportOptions& o)
{
    ReportPlan out;
    out.scenes = o.scenes.empty() ? scenes_here() : o.scenes;
    out.quick = o.quick;
    if (o.quick) out.picture = {48, 27};
    if (!o.size.empty()) out.picture = host::parse_picture_size(o.size);
    require_readable(out, o.allow_path);
    out.devices = devices_of(o);
    return out;
}

void measure(ReportPart& part, const ReportOptions& o)
{
    if (!o.quiet)
        fmt::print(stderr, "{}: {} contenders, {} scenes\n", part.title, part.settings.contenders.size(),
                   part.scenes.size());
    for (const std::string& file : part.scenes) {
        leave_out_hopeless(part);
        if (part.settings.contenders.empty()) return;
        host::ProgressBar bar(file, !o.quiet);
        part.results.push_back(
            measure_speed({file, "", o.allow_path}, part.settings, [&](double done) { bar.update(done); }));
    }
}

void run(const ReportOptions& o)
{
    const ReportPlan plan = plan_of(o);
    require_folder(o.folder);
    const TemporaryFolder fields, programs;
    CompiledPrograms compiled{programs.path()};
    Report report{host::infos(host::list_devices()), report_parts(plan, fields.path()), machine_load()};
    for (ReportPart& part : report.parts) {
        part.settings.compiled = &compiled;
        measure(part, o);
        if (part.settings.settings_error && !o.no_calibrate) store_calibrations(part.results, plan.devices, o.quiet);
    }
    write_report(o.folder, report);
    if (!o.quiet) fmt::print(stderr, "{}\n", (std::filesystem::path(o.folder) / "report.html").string());
}

} // namespace

void add_report(CLI::App& app)
{
    auto options = std::make_shared<ReportOptions>();
    CLI::App* command =
        app.add_subcommand("report", "How fast and how right all devices here are, as a page with plots");
    command->add_option("scenes", options->scenes, "scenes' files; else those in the folder 'scenes'")
        ->option_text("SCENE...");
    command->add_option("-o,--output", options->folder, "folder for report.html, .md, .json and the plots")
        ->option_text("FOLDER")
        ->capture_default_str();
    command
        ->add_option("--device", options->devices,
                     "P:D, a part of a name, cpu, gpu or all; again for another device. The first one is looked at "
                     "closely. Else all that work")
        ->allow_extra_args(false)
        ->option_text("WHICH");
    command->add_option("-s,--size", options->size, "of the pictures, 160x90 unless given")->option_text("WxH");
    command->add_option("--allow-path", options->allow_path, "photographs may also lie beneath this folder")
        ->option_text("FOLDER");
    command->add_flag("--quick", options->quick, "tiny pictures and few rounds: to see that all works");
    command->add_flag("--no-calibrate", options->no_calibrate,
                      "keep nothing for `clucida render --max-error`, which else goes by this");
    command->add_flag("-q,--quiet", options->quiet, "print no progress");
    command->footer("Examples:\n"
                    "  clucida-bench report\n"
                    "  clucida-bench report scenes/*.clu -o figures --device cpu --device gpu\n"
                    "  clucida-bench report --quick -o /tmp/report scenes/lamp.clu");
    command->callback([options] { run(*options); });
}

} // namespace clucida::bench
