#include "bench/commands.h"
#include "bench/profile_output.h"
#include "bench/speed_axes.h"
#include "bench/write_json.h"
#include "host/arguments.h"
#include "host/atomic_file.h"
#include "host/commands.h"
#include "host/errors.h"
#include "host/progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <thread>

namespace clucida::bench {
namespace {

const std::vector<std::string> part_names{"counts", "time", "fixed", "code", "executed"};

struct ProfileOptions {
    std::vector<std::string> scenes, parts = part_names;
    std::string format, allow_path, device, compiler, json;
    std::string size = "320x180", executed_size = "160x90", precision = "float", kernel = "auto";
    unsigned rounds = 9;
    bool quiet = false;
};

ProfileSettings settings_of(const ProfileOptions& o)
{
    ProfileSettings out;
    out.picture = host::parse_picture_size(o.size);
    out.executed_picture = host::parse_picture_size(o.executed_size);
    out.precision = o.precision == "double" ? host::Precision::twofold : host::Precision::single;
    out.kernel = parse_kernel(o.kernel);
    out.rounds = o.rounds;
    out.compiler = o.compiler;
    out.oracle_threads = std::max(std::thread::hardware_concurrency(), 1U);
    const auto asked = [&](const char* name) { return std::ranges::find(o.parts, name) != o.parts.end(); };
    out.parts = {asked("counts"), asked("time"), asked("fixed"), asked("code"), asked("executed")};
    for (const std::string& file : o.scenes)
        if (file == "-") throw host::UsageError("a scene that is profiled is read several times: it must be a file");
    return out;
}

void run(const ProfileOptions& o)
{
    const ProfileSettings settings = settings_of(o);
    if (!o.json.empty() && o.json != "-") host::require_writable(o.json);
    const host::Device device = host::find_device(host::device_selector(o.device));
    if (settings.precision == host::Precision::twofold) host::require_double(device.info);
    if (!o.quiet) fmt::print(stderr, "device {}\n", describe(device.info));
    std::FILE* const to = o.json == "-" ? stderr : stdout;
    std::vector<SceneProfile> profiles;
    for (const std::string& file : o.scenes) {
        {
            host::ProgressBar bar(file, !o.quiet);
            profiles.push_back(measure_profile({file, o.format, o.allow_path, false}, device, settings,
                                               [&](double done) { bar.update(done); }));
        }
        print_profile(to, profiles.back(), settings, device.info);
        std::fflush(to);
    }
    if (!o.json.empty()) write_json(o.json, profile_json(profiles, settings, device.info));
}

void add_options(CLI::App& command, ProfileOptions& o)
{
    command.add_option("scenes", o.scenes, "scenes' files")->required()->option_text("SCENE...");
    command.add_option("--format", o.format, "of the scenes: clucida, gun or rayt; else by each file's ending")
        ->option_text("NAME");
    command.add_option("--allow-path", o.allow_path, "photographs may also lie beneath this folder")
        ->option_text("FOLDER");
    command.add_option("-s,--size", o.size, "of the picture in pixels")->option_text("WxH")->capture_default_str();
    command.add_option("--executed-size", o.executed_size, "of the picture under Valgrind, some 500 times as slow")
        ->option_text("WxH")
        ->capture_default_str();
    command.add_option("--device", o.device, "P:D (see `clucida devices`), a part of a name, cpu or gpu")
        ->option_text("WHICH");
    command.add_option("--precision", o.precision, "float or double")
        ->check(CLI::IsMember({"float", "double"}))
        ->option_text("NAME")
        ->capture_default_str();
    command.add_option("--kernel", o.kernel, "auto (as the device is), pixels or packets")
        ->check(CLI::IsMember({"auto", "pixels", "packets"}))
        ->option_text("NAME")
        ->capture_default_str();
    command.add_option("--parts", o.parts, "what to measure: counts, time, fixed, code, executed; else all")
        ->delimiter(',')
        ->check(CLI::IsMember(part_names))
        ->option_text("NAME,...");
    command.add_option("--compiler", o.compiler, "of the native build; else clang, else cc")->option_text("NAME");
    command.add_option("--rounds", o.rounds, "in which all that is timed takes turns")
        ->check(host::number_within(1, 100000))
        ->option_text("N")
        ->capture_default_str();
    command
        .add_option("--json", o.json,
                    "also write a report in the shape of Google Benchmark's; -: to standard output, and the tables to "
                    "standard error")
        ->option_text("FILE");
    command.add_flag("-q,--quiet", o.quiet, "print no progress");
}

} // namespace

void add_profile(CLI::App& app)
{
    auto options = std::make_shared<ProfileOptions>();
    CLI::App* command = app.add_subcommand("profile", "Where the time goes: counts, stages, machine code");
    add_options(*command, *options);
    command->footer("Examples:\n"
                    "  clucida-bench profile scene.clu\n"
                    "  clucida-bench profile scene.clu --parts counts,time -s 640x360\n"
                    "  clucida-bench profile scenes/*.clu --device pocl --json profile.json\n"
                    "\ndocs/where-the-time-goes.md says what the figures mean.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::bench
