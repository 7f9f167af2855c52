#include "host/arguments.h"
#include "host/commands.h"
#include "host/errors.h"
#include "host/interrupt.h"
#include "host/progress.h"
#include "host/render_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

namespace clucida::host {
namespace {

struct RenderOptions {
    SceneOptions scene;
    std::string output, format_out, size = "640x360", tile, device, precision = "float", kernel = "auto";
    unsigned samples = 1, depth = 8, quality = 90;
    std::optional<unsigned> max_hops;
    std::optional<double> cutoff;
    bool quiet = false, json = false, overwrite = false, skip_existing = false, no_kernel_cache = false;
};

/// The command in as many words as determine the picture: the same picture has the same metadata.
std::string canonical_command(const RenderOptions& o, const std::string& scene)
{
    std::string out =
        fmt::format("clucida render {} -s {} --samples {} --precision {}", scene, o.size, o.samples, o.precision);
    if (o.max_hops) out += fmt::format(" --max-hops {}", *o.max_hops);
    if (o.cutoff) out += fmt::format(" --cutoff {}", *o.cutoff);
    if (!o.scene.format.empty()) out += " --format " + o.scene.format;
    if (o.scene.as_original) out += " --as-original";
    return out;
}

EncodeOptions encoding(const RenderOptions& o, const SceneSource& source, const std::string& device)
{
    EncodeOptions out;
    out.transfer = source.as_original == scene::AsOriginal::gun ? Transfer::linear : Transfer::srgb;
    out.depth = o.depth;
    out.quality = o.quality;
    out.metadata = {{"Software", "clucida " CLUCIDA_VERSION},
                    {"Command", canonical_command(o, source.name)},
                    {"Scene SHA-256", source.hash},
                    {"Device", device},
                    {"Frame", "0"}};
    return out;
}

void report(const RenderOptions& o, const Output& output, const Frame& frame, const Stages& stages)
{
    if (!frame.note.empty() && !o.quiet) fmt::print(stderr, "clucida: note: {}\n", frame.note);
    const std::string faults = describe_faults(frame.statistics);
    if (!faults.empty()) fmt::print(stderr, "clucida: warning: the picture has faults: {}\n", faults);
    if (!o.quiet) fmt::print(stderr, "{}\n", timing_line(output.file, frame, o.samples, stages));
    if (!o.json) return;
    nlohmann::ordered_json j = {
        {"scene", o.scene.file}, {"output", output.file}, {"samples", o.samples}, {"precision", o.precision}};
    j.update(frame_json(frame, stages));
    auto& stream = output.file == "-" ? std::cerr : std::cout;
    stream << j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

void run(const RenderOptions& o)
{
    const Stopwatch total;
    Stages stages;
    const Shape size = parse_picture_size(o.size);
    RenderSettings settings;
    settings.picture = size;
    settings.samples = o.samples;
    settings.precision = o.precision == "double" ? Precision::twofold : Precision::single;
    if (o.kernel != "auto") settings.kernel = o.kernel == "packets" ? KernelShape::packets : KernelShape::pixels;
    settings.cache = o.no_kernel_cache ? KernelCache::off : KernelCache::automatic;
    if (!o.tile.empty()) settings.tile = parse_size(o.tile, "the tile's size");

    const std::string stem = o.scene.file == "-" ? "picture" : std::filesystem::path(o.scene.file).stem().string();
    const Output output = choose_output(o.output, o.format_out, stem);
    require_encodable(size.width, size.height, output.format, encoding(o, {}, ""));
    if (o.skip_existing && output.file != "-" && std::filesystem::exists(output.file)) {
        if (!o.quiet) fmt::print(stderr, "{} exists, kept\n", output.file);
        return;
    }

    Stopwatch watch;
    SceneSource source = load_scene(o.scene);
    stages.read = watch.lap();
    const scene::Compiled compiled =
        compile_scene(source, {size.width, size.height, o.samples, o.max_hops, o.cutoff, source.as_original});
    source.scene = {}; // a million objects are some hundred MiB, which tracing need not keep
    source.text = {};
    stages.compile = watch.lap();
    const Device device = find_device(device_selector(o.device));
    stages.devices = watch.lap();
    if (!o.quiet) fmt::print(stderr, "device {}\n", describe(device.info));
    if (settings.precision == Precision::twofold) require_double(device.info);

    watch.lap();
    Renderer renderer = make_renderer(device);
    stages.context = watch.lap();
    OutputStream stream(output, size, encoding(o, source, describe(device.info)));
    Frame frame;
    {
        ProgressBar bar(output.file, !o.quiet);
        frame = render_frame(renderer, compiled, settings,
                             {[&](double done) { bar.update(done); }, interrupted,
                              [&](unsigned y, std::span<const float> rgb) { stream.add(y, rgb); }});
    }
    watch.lap();
    stream.commit(interrupted);
    stages.write = watch.lap();
    stages.total = total.seconds();
    report(o, output, frame, stages);
}

void add_picture_options(CLI::App& command, RenderOptions& o)
{
    command
        .add_option("-o,--output", o.output,
                    "the picture's file, or - for standard output; else the scene's name and .png. The ending says "
                    "which format: " +
                        file_endings())
        ->option_text("FILE");
    command.add_option("--format-out", o.format_out, "the picture's format, whatever the ending")->option_text("NAME");
    command.add_option("-s,--size", o.size, "of the picture in pixels")->option_text("WxH")->capture_default_str();
    command.add_option("--depth", o.depth, "bits of a channel in png and ppm, 8 or 16")->option_text("BITS");
    command.add_option("--quality", o.quality, "of JPEG, 1 to 100")->option_text("N");
    auto* overwrite = command.add_flag("--overwrite", o.overwrite, "replace an existing picture (the default)");
    command.add_flag("--skip-existing", o.skip_existing, "keep an existing picture")->excludes(overwrite);
}

void add_tracing_options(CLI::App& command, RenderOptions& o)
{
    command.add_option("--samples", o.samples, "of each pixel")
        ->check(number_within(1, 1U << 20))
        ->option_text("N")
        ->capture_default_str();
    command.add_option("--max-hops", o.max_hops, "surfaces that a ray may meet; else the scene's")
        ->check(number_within(1, 1000000))
        ->option_text("N");
    command.add_option("--cutoff", o.cutoff, "rays of less weight end; 0 to 1, else the scene's")
        ->check(number_within(0, 1))
        ->option_text("X");
    command.add_option("--precision", o.precision, "float or double")
        ->check(CLI::IsMember({"float", "double"}))
        ->option_text("NAME");
    command
        .add_option("--kernel", o.kernel,
                    "pixels (a work-item each, for GPUs), packets (of eight rays, for CPUs), or auto: as the device is")
        ->check(CLI::IsMember({"auto", "pixels", "packets"}))
        ->option_text("NAME");
    command.add_option("--device", o.device, "P:D (see `clucida devices`), a part of a name, cpu or gpu")
        ->option_text("WHICH");
    command.add_option("--tile", o.tile, "the shape of a launch; else measured")->option_text("WxH");
    command.add_flag("--no-kernel-cache", o.no_kernel_cache, "compile anew, keep nothing");
}

} // namespace

void add_render(CLI::App& app)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a scene to a picture");
    add_scene_options(*command, options->scene);
    add_picture_options(*command, *options);
    add_tracing_options(*command, *options);
    command->add_flag("-q,--quiet", options->quiet, "print errors and warnings only");
    command->add_flag("--json", options->json,
                      "statistics and times as JSON on standard output (standard error with -o -)");
    command->footer("Examples:\n"
                    "  clucida render scene.clu\n"
                    "  clucida render scene.clu -o out.hdr -s 1920x1080 --samples 64\n"
                    "  clucida render scene.clu -o - --format-out ppm | ffmpeg -i - out.webp\n"
                    "\nThe environment's CLUCIDA_DEVICE chooses like --device.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::host
