#include "bench/commands.h"
#include "bench/error_output.h"
#include "bench/precision_name.h"
#include "bench/variants.h"
#include "host/arguments.h"
#include "host/commands.h"
#include "host/errors.h"
#include "host/false_color.h"
#include "host/progress.h"
#include "host/render_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <thread>

namespace clucida::bench {
namespace {

struct ErrorOptions {
    std::vector<std::string> scenes, precisions{"float"}, variants{full_variant};
    std::string format, allow_path, size = "640x360", oracle = "long-double", device, output;
    unsigned threads = std::max(std::thread::hardware_concurrency(), 1U), repeats = 3;
    bool json = false, markdown = false, no_costs = false, quiet = false;
};

constexpr host::Scale error_scale = {.least = 1e-8, .most = 1, .logarithmic = true};

ErrorSettings settings_of(const ErrorOptions& o)
{
    ErrorSettings out;
    out.picture = host::parse_picture_size(o.size);
    out.contenders.clear();
    for (const std::string& variant : o.variants)
        for (const std::string& precision : o.precisions)
            out.contenders.push_back(
                {precision == "double" ? host::Precision::twofold : host::Precision::single, variant});
    out.oracle = real_type(o.oracle);
    out.repeats = o.repeats;
    out.costs = !o.no_costs;
    out.threads = o.threads;
    return out;
}

/// Where the picture errs, in false colours.
void write_map(const host::Output& output, const NamedError& result)
{
    const ErrorReport& report = result.error.reports.front();
    const host::Plane errors = host::error_map(report.picture, result.error.truth);
    const host::Picture picture = host::with_legend(host::false_color(errors, error_scale), error_scale);
    host::EncodeOptions encoding;
    encoding.metadata = {
        {"Software", "clucida " CLUCIDA_VERSION},
        {"Command",
         fmt::format("clucida-bench error {} -s {}x{} --precision {} --variant {}", result.scene, report.picture.width,
                     report.picture.height, precision_name(report.contender.precision), report.contender.variant)}};
    host::write_output(output, host::encode(picture, output.format, encoding));
}

NamedError measure(const ErrorOptions& o, const std::string& file, const host::Device& device,
                   const ErrorSettings& settings)
{
    const host::SceneSource source = host::load_scene({file, o.format, o.allow_path, false});
    host::ProgressBar bar(source.name, !o.quiet);
    return {source.name, measure_error(source, device, settings, [&](double done) { bar.update(done); })};
}

void run(const ErrorOptions& o)
{
    const ErrorSettings settings = settings_of(o);
    const std::size_t pictures = o.scenes.size() * settings.contenders.size();
    if (!o.output.empty() && pictures != 1)
        throw host::UsageError("a picture of where the error is shows one scene in one precision and one variant");
    std::optional<host::Output> output;
    if (!o.output.empty()) output = host::choose_output(o.output, "", "");
    const host::Device device = host::find_device(host::device_selector(o.device));
    if (!o.quiet) fmt::print(stderr, "device {}\n", describe(device.info));
    for (const Contender& c : settings.contenders)
        if (c.precision == host::Precision::twofold) host::require_double(device.info);

    std::FILE* const to = output && output->file == "-" ? stderr : stdout;
    std::vector<NamedError> results;
    for (const std::string& file : o.scenes) {
        results.push_back(measure(o, file, device, settings));
        if (output) write_map(*output, results.back());
        for (ErrorReport& r : results.back().error.reports) r.picture = {};
        results.back().error.truth = {};
        if (!o.json && !o.markdown) print_error(to, results.back(), settings);
        if (!o.quiet && (o.json || o.markdown)) fmt::print(stderr, "{} done\n", file);
        std::fflush(to);
    }
    if (o.json)
        fmt::print(
            to, "{}\n",
            error_json(results, settings, o.oracle).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else if (o.markdown)
        print_tables(to, results, settings);
}

void add_options(CLI::App& command, ErrorOptions& o)
{
    command.add_option("scenes", o.scenes, "scenes' files")->required()->option_text("SCENE...");
    command.add_option("--format", o.format, "of the scenes: clucida, gun or rayt; else by each file's ending")
        ->option_text("NAME");
    command.add_option("--allow-path", o.allow_path, "photographs may also lie beneath this folder")
        ->option_text("FOLDER");
    command.add_option("-s,--size", o.size, "of the picture in pixels")->option_text("WxH")->capture_default_str();
    command.add_option("--precision", o.precisions, "float or double, or both: --precision float,double")
        ->delimiter(',')
        ->check(CLI::IsMember({"float", "double"}))
        ->option_text("NAME,...");
    command.add_option("--variant", o.variants, fmt::format("of the kernels: {}", fmt::join(variant_names(), ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(variant_names()))
        ->option_text("NAME,...");
    command
        .add_option("--oracle", o.oracle,
                    "its numbers: double, long-double, quad or mpfr; what differs is asked again in quad")
        ->check(CLI::IsMember({"double", "long-double", "quad", "mpfr"}))
        ->option_text("NAME")
        ->capture_default_str();
    command.add_option("--device", o.device, "P:D (see `clucida devices`), a part of a name, cpu or gpu")
        ->option_text("WHICH");
    command.add_option("--threads", o.threads, "of the oracle")
        ->check(host::number_within(1, 1024))
        ->option_text("N")
        ->capture_default_str();
    command.add_option("--repeats", o.repeats, "pictures that are timed")
        ->check(host::number_within(1, 1000))
        ->option_text("N")
        ->capture_default_str();
    command.add_flag("--no-costs", o.no_costs,
                     "leave out what one rounding, compressed colours, cutoff and hop limit cost");
    command.add_option("-o,--output", o.output, "write a picture of where the error is; -: standard output")
        ->option_text("FILE");
    CLI::Option* json = command.add_flag("--json", o.json, "in the shape of Google Benchmark's");
    command.add_flag("--markdown", o.markdown, "as tables")->excludes(json);
    command.add_flag("-q,--quiet", o.quiet, "print results, errors and warnings only");
}

} // namespace

void add_error(CLI::App& app)
{
    auto options = std::make_shared<ErrorOptions>();
    CLI::App* command = app.add_subcommand("error", "How far pictures are from the oracle's, and why");
    add_options(*command, *options);
    command->footer("Examples:\n"
                    "  clucida-bench error scene.clu\n"
                    "  clucida-bench error scene.clu -s 320x180 --precision double -o where.png\n"
                    "  clucida-bench error scenes/*.clu --precision float,double --markdown\n"
                    "\ndocs/numerics.md says what the figures mean.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::bench
