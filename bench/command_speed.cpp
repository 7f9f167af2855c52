#include "bench/commands.h"
#include "bench/speed_output.h"
#include "host/arguments.h"
#include "host/atomic_file.h"
#include "host/commands.h"
#include "host/errors.h"
#include "host/progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <memory>
#include <thread>

namespace clucida::bench {
namespace {

struct SpeedOptions {
    std::vector<std::string> scenes, precisions{"float"}, threads{"all"}, kernels{"auto"}, devices;
    std::string format, allow_path, size = "640x360", compiler, error, json;
    unsigned samples = 1, rounds = 9;
    std::size_t error_pixels = 1000;
    std::optional<unsigned> max_hops;
    std::optional<double> cutoff;
    bool as_original = false, native = false, quiet = false;
};

constexpr unsigned most_threads = 1024;

/// "all" is 0.
unsigned thread_limit(const std::string& text)
{
    unsigned out = 0;
    if (text == "all") return out;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error != std::errc() || end != text.data() + text.size() || out < 1 || out > most_threads)
        throw host::UsageError(
            fmt::format("threads '{}' is wrong: expected all or a number from 1 to {}", text, most_threads));
    return out;
}

std::vector<host::Precision> precisions_of(const SpeedOptions& o)
{
    std::vector<host::Precision> out;
    const auto add = [&](host::Precision p) {
        if (std::ranges::find(out, p) == out.end()) out.push_back(p);
    };
    for (const std::string& name : o.precisions) {
        if (name != "double") add(host::Precision::single);
        if (name != "float") add(host::Precision::twofold);
    }
    return out;
}

std::vector<host::Device> devices_of(const SpeedOptions& o)
{
    if (o.devices.empty()) return {host::find_device(host::device_selector(""))};
    std::vector<host::Device> out;
    for (const std::string& selector : o.devices) out.push_back(host::find_device(selector));
    return out;
}

/// What has no threads of the host's to be limited enters once.
std::vector<SpeedContender> contenders_of(const SpeedOptions& o, const std::vector<host::Device>& devices)
{
    std::vector<unsigned> limits;
    for (const std::string& text : o.threads) limits.push_back(thread_limit(text));
    std::vector<std::optional<host::KernelShape>> kernels;
    for (const std::string& name : o.kernels) {
        if (name == "auto")
            kernels.emplace_back();
        else
            kernels.emplace_back(name == "packets" ? host::KernelShape::packets : host::KernelShape::pixels);
    }
    std::vector<SpeedContender> out;
    for (const host::Precision precision : precisions_of(o)) {
        for (const host::Device& device : devices) {
            if (precision == host::Precision::twofold) host::require_double(device.info);
            const std::string place = fmt::format("{}:{}", device.info.platform, device.info.device);
            const bool limited = device.info.kind == host::DeviceKind::cpu;
            for (const auto& kernel : kernels)
                for (const unsigned limit : limited ? limits : std::vector{0U})
                    out.push_back({place, precision, limit, kernel});
        }
        if (!o.native) continue;
        for (const auto& kernel : kernels)
            for (const unsigned limit : limits) out.push_back({"", precision, limit, kernel});
    }
    return out;
}

/// The oracle, unless it knows nothing of what is asked for.
ErrorFrom error_of(const SpeedOptions& o)
{
    if (o.error.empty()) return o.as_original ? ErrorFrom::double_kernel : ErrorFrom::oracle;
    if (o.error == "none") return ErrorFrom::none;
    return o.error == "oracle" ? ErrorFrom::oracle : ErrorFrom::double_kernel;
}

SpeedSettings settings_of(const SpeedOptions& o)
{
    SpeedSettings out;
    out.task.picture = host::parse_picture_size(o.size);
    out.task.samples = o.samples;
    out.task.max_hops = o.max_hops;
    out.task.cutoff = o.cutoff;
    out.task.native.compiler = o.compiler;
    out.rounds = o.rounds;
    out.error = error_of(o);
    out.error_pixels = o.error_pixels;
    out.oracle_threads = std::max(std::thread::hardware_concurrency(), 1U);
    if (out.error == ErrorFrom::oracle && o.as_original)
        throw host::UsageError("the oracle knows the optical model only, not what the original programs made of it: "
                               "--error double or none");
    for (const std::string& file : o.scenes)
        if (file == "-") throw host::UsageError("a scene that is timed is read several times: it must be a file");
    const std::vector<host::Device> devices = devices_of(o);
    out.contenders = contenders_of(o, devices);
    out.reference_device = fmt::format("{}:{}", devices.front().info.platform, devices.front().info.device);
    if (out.error == ErrorFrom::double_kernel) host::require_double(devices.front().info);
    return out;
}

/// A limit that a device makes nothing of would make its row a lie.
void warn_of_threads(const SceneSpeed& speed)
{
    for (const SpeedReport& r : speed.reports)
        if (r.contender.threads && r.threads != r.contender.threads)
            fmt::print(stderr, "clucida-bench: warning: {}: the device has {} threads, not as many as asked for\n",
                       describe(r.contender), r.threads);
}

void run(const SpeedOptions& o)
{
    const SpeedSettings settings = settings_of(o);
    if (!o.json.empty() && o.json != "-") host::require_writable(o.json);
    std::FILE* const to = o.json == "-" ? stderr : stdout;
    const Load load = machine_load();
    std::vector<SceneSpeed> results;
    for (const std::string& file : o.scenes) {
        {
            host::ProgressBar bar(file, !o.quiet);
            results.push_back(measure_speed({file, o.format, o.allow_path, o.as_original}, settings,
                                            [&](double done) { bar.update(done); }));
        }
        warn_of_threads(results.back());
        if (results.size() == 1) print_speed_head(to);
        print_speed(to, results.back());
        std::fflush(to);
    }
    print_speed_note(to, results, settings, load);
    if (o.json.empty()) return;
    const std::string text =
        speed_json(results, settings, load).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    if (o.json == "-")
        fmt::print("{}", text);
    else
        host::write_file(o.json, text);
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
    command.add_option("-s,--size", o.size, "of the picture in pixels")->option_text("WxH")->capture_default_str();
    command.add_option("--samples", o.samples, "of each pixel")
        ->check(host::number_within(1, 1U << 20))
        ->option_text("N")
        ->capture_default_str();
    command.add_option("--max-hops", o.max_hops, "surfaces that a ray may meet; else the scene's")
        ->check(host::number_within(1, 1000000))
        ->option_text("N");
    command.add_option("--cutoff", o.cutoff, "rays of less weight end; 0 to 1, else the scene's")
        ->check(host::number_within(0, 1))
        ->option_text("X");
}

void add_contender_options(CLI::App& command, SpeedOptions& o)
{
    command
        .add_option("--device", o.devices,
                    "P:D (see `clucida devices`), a part of a name, cpu or gpu; again for another device")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->option_text("WHICH");
    command.add_option("--precision", o.precisions, "float, double or both")
        ->delimiter(',')
        ->check(CLI::IsMember({"float", "double", "both"}))
        ->option_text("NAME,...");
    command.add_option("--kernel", o.kernels, "auto (as the device is), pixels or packets: --kernel pixels,packets")
        ->delimiter(',')
        ->check(CLI::IsMember({"auto", "pixels", "packets"}))
        ->option_text("NAME,...");
    command.add_option("--threads", o.threads, "limits of a CPU's threads: --threads 1,2,all")
        ->delimiter(',')
        ->option_text("N,...");
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
        .add_option("--error", o.error,
                    "what pictures are held against: oracle, the kernel in double, or none; else the oracle, and the "
                    "kernel in double with --as-original")
        ->check(CLI::IsMember({"oracle", "double", "none"}))
        ->option_text("WHAT");
    command.add_option("--error-pixels", o.error_pixels, "at most as many, on a regular grid")
        ->check(host::number_within(1, 1U << 20))
        ->option_text("N")
        ->capture_default_str();
    command
        .add_option("--json", o.json,
                    "also write a report in the shape of Google Benchmark's; -: to standard output, and the table to "
                    "standard error")
        ->option_text("FILE");
    command.add_flag("-q,--quiet", o.quiet, "print no progress");
}

} // namespace

void add_speed(CLI::App& app)
{
    auto options = std::make_shared<SpeedOptions>();
    CLI::App* command = app.add_subcommand("speed", "How fast pictures are traced, and how far they are from right");
    add_scene_options(*command, *options);
    add_contender_options(*command, *options);
    add_measure_options(*command, *options);
    command->footer(
        "Examples:\n"
        "  clucida-bench speed scene.clu\n"
        "  clucida-bench speed scenes/*.clu -s 320x180 --threads 1,all --native\n"
        "  clucida-bench speed scene.clu --device pocl --device gpu --precision both --json speed.json\n"
        "  clucida-bench speed scene.gun --as-original --rounds 25\n"
        "\nThe first contender is the one that ratios are to. docs/user-guide.md says what the figures mean.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::bench
