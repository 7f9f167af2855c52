#include "bench/speed_options.h"

#include "bench/speed_axes.h"
#include "host/arguments.h"
#include "host/commands.h"
#include "host/devices.h"
#include "host/errors.h"

#include <algorithm>
#include <limits>
#include <thread>

namespace clucida::bench {
namespace {

template <class Parse>
auto each(const std::vector<std::string>& texts, const Parse& parse)
{
    std::vector<decltype(parse(texts.front()))> out;
    for (const std::string& text : texts) {
        auto value = parse(text);
        if (std::ranges::find(out, value) == out.end()) out.push_back(std::move(value));
    }
    return out;
}

std::vector<host::Precision> precisions_of(const SpeedOptions& o)
{
    std::vector<std::string> names;
    for (const std::string& name : o.precisions) {
        if (name != "double") names.emplace_back("float");
        if (name != "float") names.emplace_back("double");
    }
    return each(names, [](const std::string& name) {
        return name == "double" ? host::Precision::twofold : host::Precision::single;
    });
}

SpeedAxes axes_of(const SpeedOptions& o, const std::vector<host::DeviceInfo>& devices)
{
    SpeedAxes out;
    out.devices = devices;
    out.native = o.native;
    out.precisions = precisions_of(o);
    out.kernels = each(o.kernels, parse_kernel);
    out.groups = each(o.groups, parse_local_size);
    out.threads = each(o.threads, parse_thread_limit);
    out.pictures = each(o.sizes, [](const std::string& text) { return host::parse_picture_size(text); });
    out.samples = each(o.samples, parse_samples);
    out.max_hops = each(o.max_hops, parse_max_hops);
    out.cutoffs = each(o.cutoffs, parse_cutoff);
    return out;
}

/// Without words for it: where settings are to be chosen their error, else the arithmetic's, from the oracle unless it
/// knows nothing of what is asked for.
void add_errors(const SpeedOptions& o, SpeedSettings& to)
{
    const auto asked = [&](const char* what) { return std::ranges::find(o.errors, what) != o.errors.end(); };
    if (o.errors.empty() && o.as_original)
        to.error = ErrorFrom::double_kernel;
    else if (o.errors.empty() && !o.calibrate && !o.max_error)
        to.error = ErrorFrom::oracle;
    else
        to.error = ErrorFrom::none;
    if (asked("double")) to.error = ErrorFrom::double_kernel;
    if (asked("oracle")) to.error = ErrorFrom::oracle;
    to.settings_error = asked("reference") || (o.errors.empty() && to.error == ErrorFrom::none);
    if (asked("double") && asked("oracle"))
        throw host::UsageError("--error names two truths for the arithmetic, the oracle and double: expected one");
    if (asked("none") && o.errors.size() > 1) throw host::UsageError("--error none allows no other");
    if (o.as_original && asked("oracle"))
        throw host::UsageError("the oracle knows the optical model only, not what the original programs made of it: "
                               "--error double or none");
    if (o.calibrate && (!to.settings_error || o.as_original))
        throw host::UsageError("--calibrate keeps the errors of --error reference, of the optical model");
}

void add_scene_options(CLI::App& command, SpeedOptions& o)
{
    command.add_option("scenes", o.scenes, "scenes' files")->required()->option_text("SCENE...");
    command.add_option("--format", o.format, "of the scenes: clucida, gun or rayt; else by each file's ending")
        ->option_text("NAME");
    command.add_option("--allow-path", o.allow_path, "photographs may also lie beneath this folder")
        ->option_text("FOLDER");
    command.add_flag("--as-original", o.as_original,
                     "imitate the original programs of the scenes' formats, defects included");
}

CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& to, const char* what,
                      const char* text)
{
    return command.add_option(name, to, what)->delimiter(',')->option_text(text)->allow_extra_args(false);
}

void add_axes(CLI::App& command, SpeedOptions& o)
{
    command
        .add_option("--device", o.devices,
                    "P:D (see `clucida devices`), a part of a name, cpu, gpu or all; again for another device")
        ->allow_extra_args(false)
        ->option_text("WHICH");
    add_list(command, "--precision", o.precisions, "float, double or both", "NAME,...")
        ->check(CLI::IsMember({"float", "double", "both"}));
    add_list(command, "--kernel", o.kernels, "auto (as the device is), pixels or packets: --kernel pixels,packets",
             "NAME,...")
        ->check(CLI::IsMember({"auto", "pixels", "packets"}));
    add_list(command, "--threads", o.threads, "limits of a CPU's threads: --threads 1,2,all", "N,...");
    add_list(command, "--local-size", o.groups,
             "work-items of a work-group of the kernel of pixels: --local-size auto,8x8,32x2", "WxH,...");
    add_list(command, "-s,--size", o.sizes, "of the picture in pixels: -s 320x180,640x360", "WxH,...");
    add_list(command, "--samples", o.samples, "of each pixel: --samples 1,4,16", "N,...");
    add_list(command, "--max-hops", o.max_hops, "surfaces that a ray may meet: --max-hops 4,scene", "N,...");
    add_list(command, "--cutoff", o.cutoffs, "rays of less weight end; 0 to 1: --cutoff scene,0.01", "X,...");
    command.add_flag("--native", o.native, "also the kernels' core as this machine's C compiler compiles it");
    command.add_option("--compiler", o.compiler, "of --native; else clang, else cc")->option_text("NAME");
}

void add_measure_options(CLI::App& command, SpeedOptions& o)
{
    command.add_option("--rounds", o.rounds, "in which the contenders take turns")
        ->check(host::number_within(1, 100000))
        ->option_text("N")
        ->capture_default_str();
    command
        .add_option("--seconds", o.seconds,
                    "after which a contender takes no further turn, if it had three; else it takes part in all rounds")
        ->check(host::number_within(0, 1e6))
        ->option_text("S");
    add_list(command, "--error", o.errors,
             "what pictures are held against: of the same settings oracle or double (the kernel's), of many more "
             "samples reference; or none. Else the oracle; reference with --max-error and --calibrate; double with "
             "--as-original",
             "WHAT,...")
        ->check(CLI::IsMember({"oracle", "double", "reference", "none"}));
    command.add_option("--error-pixels", o.error_pixels, "for oracle and double at most as many, on a regular grid")
        ->check(host::number_within(1, 1U << 20))
        ->option_text("N")
        ->capture_default_str();
    command
        .add_option("--max-error", o.max_error,
                    "recommend for each scene the fastest settings whose RMSE is at most that")
        ->check(host::number_within(std::numeric_limits<double>::min(), 1e30))
        ->option_text("E");
    command.add_flag("--calibrate", o.calibrate, "keep what --error reference tells for `clucida render --max-error`");
    command.add_flag("--keep-going", o.keep_going, "a contender that fails gets a row that says so");
}

void add_output_options(CLI::App& command, SpeedOptions& o)
{
    command
        .add_option("--json", o.json,
                    "also write a report in the shape of Google Benchmark's; -: to standard output, and the table to "
                    "standard error")
        ->option_text("FILE");
    command.add_option("--csv", o.csv, "also write the figures as comma-separated values")->option_text("FILE");
    command.add_option("--html", o.html, "also write a page with plots that needs no other file")->option_text("FILE");
    command.add_option("--svg", o.svg, "also write the plots as files into that folder")->option_text("FOLDER");
    command.add_option("--compare", o.compare, "tell what has changed from that report")->option_text("OLD.json");
    command.add_flag("-q,--quiet", o.quiet, "print no progress");
}

} // namespace

void add_speed_options(CLI::App& command, SpeedOptions& options)
{
    add_scene_options(command, options);
    add_axes(command, options);
    add_measure_options(command, options);
    add_output_options(command, options);
}

std::vector<host::DeviceInfo> devices_of(const SpeedOptions& o)
{
    if (o.devices.empty()) return {host::find_device(host::device_selector("")).info};
    const std::vector<host::DeviceInfo> all = host::infos(host::list_devices());
    std::vector<host::DeviceInfo> out;
    for (const std::string& selector : o.devices)
        for (const std::size_t i : host::choose_devices(all, selector)) out.push_back(all[i]);
    return out;
}

SpeedSettings settings_of(const SpeedOptions& o, const std::vector<host::DeviceInfo>& devices)
{
    SpeedSettings out;
    add_errors(o, out);
    out.native.compiler = o.compiler;
    out.rounds = o.rounds;
    out.most_seconds = o.seconds;
    out.keep_going = o.keep_going;
    out.error_pixels = o.error_pixels;
    out.oracle_threads = std::max(std::thread::hardware_concurrency(), 1U);
    for (const std::string& file : o.scenes)
        if (file == "-") throw host::UsageError("a scene that is timed is read several times: it must be a file");
    out.contenders = contenders_of(axes_of(o, devices));
    const auto in_double = [](const SpeedContender& c) { return c.precision == host::Precision::twofold; };
    if (std::ranges::any_of(out.contenders, in_double))
        for (const host::DeviceInfo& device : devices) host::require_double(device);
    out.reference_device = host::place(devices.front());
    if (!devices.front().has_double) out.reference_precision = host::Precision::single;
    if (out.error == ErrorFrom::double_kernel) host::require_double(devices.front());
    return out;
}

} // namespace clucida::bench
