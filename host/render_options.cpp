#include "host/render_options.h"

#include "host/arguments.h"
#include "host/commands.h"
#include "host/errors.h"
#include "host/film.h"

#include <fmt/format.h>

#include <limits>

namespace clucida::host {
namespace {

/// The command in as many words as determine the picture: the same picture has the same metadata.
std::string canonical_command(const RenderOptions& o, const std::string& scene)
{
    std::string out =
        fmt::format("clucida render {} -s {} --samples {} --precision {}", scene, o.size, o.samples, o.precision);
    if (o.max_hops) out += fmt::format(" --max-hops {}", *o.max_hops);
    if (o.cutoff) out += fmt::format(" --cutoff {}", *o.cutoff);
    if (!o.scene.format.empty()) out += " --format " + o.scene.format;
    if (o.scene.as_original) out += " --as-original";
    if (o.scene.moment.frames) out += fmt::format(" --frame-count {}", o.scene.moment.frames);
    for (const std::string& parameter : o.scene.parameters) out += " --set " + parameter;
    if (!o.stereo.empty()) out += " --stereo " + o.stereo;
    if (o.eye_separation) out += fmt::format(" --eye-separation {}", *o.eye_separation);
    if (o.screen_distance) out += fmt::format(" --screen-distance {}", *o.screen_distance);
    return out;
}

void add_picture_options(CLI::App& command, RenderOptions& o)
{
    command
        .add_option("-o,--output", o.outputs,
                    "the picture's file, or - for standard output; else the scene's name and .png. The ending says "
                    "which format: " +
                        file_endings() + "; or, for a film, " + film_endings() +
                        ". Of several frames the name has a place for the number, %04d or ####. Both a picture's and a "
                        "film's name may be given")
        ->option_text("FILE")
        ->allow_extra_args(false);
    command.add_option("--format-out", o.format_out, "the picture's format, whatever the ending")->option_text("NAME");
    command.add_option("-s,--size", o.size, "of the picture in pixels")->option_text("WxH")->capture_default_str();
    command.add_option("--depth", o.depth, "bits of a channel in png and ppm, 8 or 16")->option_text("BITS");
    command.add_option("--quality", o.quality, "of JPEG, 1 to 100")->option_text("N");
    auto* overwrite = command.add_flag("--overwrite", o.overwrite, "replace an existing picture (the default)");
    command
        .add_flag("--skip-existing", o.skip_existing,
                  "keep pictures that are whole and would come out the same: their fingerprint says so")
        ->excludes(overwrite);
}

void add_sequence_options(CLI::App& command, RenderOptions& o)
{
    command.add_option("--frames", o.frames, "which: 1-10,20-100x5,7; else all of a film's, or one")
        ->option_text("LIST");
    command.add_option("--shard", o.shard, "of N machines that share the frames this is the I-th: every N-th frame")
        ->option_text("I/N");
    command.add_flag("--dry-run", o.dry_run, "say which frames would be rendered, and into which files");
    command
        .add_option("--in-flight", o.in_flight,
                    "frames that are compiled, traced or written at a time; 1: one thing after the other")
        ->check(number_within(1, 64))
        ->option_text("N")
        ->capture_default_str();
}

void add_stereo_options(CLI::App& command, RenderOptions& o)
{
    command.add_option("--stereo", o.stereo, "for two eyes: pair (_L and _R), side-by-side, top-bottom or anaglyph")
        ->option_text("HOW");
    command
        .add_option("--eye-separation", o.eye_separation,
                    "in units of the scene; else a thirtieth of the screen's distance")
        ->check(number_within(0, 1e30))
        ->option_text("X");
    command
        .add_option("--screen-distance", o.screen_distance,
                    "where both eyes see the same; else the distance of the point that the observer looks at")
        ->check(number_within(1e-30, 1e30))
        ->option_text("X");
}

} // namespace

void add_tracing_options(CLI::App& command, RenderOptions& o)
{
    command.add_option("--samples", o.samples, "of each pixel")
        ->check(number_within(1, 1U << 20))
        ->option_text("N")
        ->capture_default_str()
        ->each([&o](const std::string&) { o.samples_given = true; });
    command.add_option("--max-hops", o.max_hops, "surfaces that a ray may meet; else the scene's")
        ->check(number_within(1, 1000000))
        ->option_text("N");
    command.add_option("--cutoff", o.cutoff, "rays of less weight end; 0 to 1, else the scene's")
        ->check(number_within(0, 1))
        ->option_text("X");
    command.add_option("--precision", o.precision, "float or double")
        ->check(CLI::IsMember({"float", "double"}))
        ->option_text("NAME")
        ->each([&o](const std::string&) { o.precision_given = true; });
    command
        .add_option("--max-error", o.max_error,
                    "the fastest precision, samples, hops and cutoff that clucida-bench has found on this device to "
                    "keep the RMSE in linear light below it; what is given stays as it is given")
        ->check(number_within(std::numeric_limits<double>::min(), 1e30))
        ->option_text("E");
    command
        .add_option("--kernel", o.kernel,
                    "pixels (a work-item each, for GPUs), packets (of eight rays, for CPUs), or auto: as the device is")
        ->check(CLI::IsMember({"auto", "pixels", "packets"}))
        ->option_text("NAME");
    command
        .add_option("--device", o.device,
                    "P:D (see `clucida devices`), a part of a name, cpu, gpu, native (without OpenCL), "
                    "all, or several with commas between: they share each picture")
        ->option_text("WHICH");
    command.add_option("--tile", o.tile, "the shape of a launch; else measured")->option_text("WxH");
    command.add_flag("--no-kernel-cache", o.no_kernel_cache, "compile anew, keep nothing");
}

void add_render_options(CLI::App& command, RenderOptions& o)
{
    add_scene_options(command, o.scene);
    add_picture_options(command, o);
    add_sequence_options(command, o);
    add_stereo_options(command, o);
    add_tracing_options(command, o);
    command.add_flag("-q,--quiet", o.quiet, "print errors and warnings only");
    command.add_flag("--json", o.json, "statistics and times as JSON on standard output (standard error with -o -)");
}

RenderSettings settings_of(const RenderOptions& o)
{
    RenderSettings settings;
    settings.picture = parse_picture_size(o.size);
    settings.samples = o.samples;
    settings.precision = o.precision == "double" ? Precision::twofold : Precision::single;
    if (o.kernel != "auto") settings.kernel = o.kernel == "packets" ? KernelShape::packets : KernelShape::pixels;
    settings.cache = o.no_kernel_cache ? KernelCache::off : KernelCache::automatic;
    if (!o.tile.empty()) settings.tile = parse_size(o.tile, "the tile's size");
    return settings;
}

scene::View view_of(const RenderOptions& o, const SceneSource& source)
{
    const Shape size = parse_picture_size(o.size);
    return {size.width, size.height, o.samples, o.max_hops, o.cutoff, source.as_original, {}};
}

Stereo stereo_of(const RenderOptions& o)
{
    const Stereo stereo{parse_stereo(o.stereo), o.eye_separation, o.screen_distance};
    if (stereo.layout == StereoLayout::none && (o.eye_separation || o.screen_distance))
        throw UsageError("--eye-separation and --screen-distance are for --stereo");
    return stereo;
}

EncodeOptions encoding_of(const RenderOptions& o, const SceneSource& source)
{
    EncodeOptions out;
    out.transfer = source.as_original == scene::AsOriginal::gun ? Transfer::linear : Transfer::srgb;
    out.depth = o.depth;
    out.quality = o.quality;
    out.metadata = {{"Software", "clucida " CLUCIDA_VERSION},
                    {"Command", canonical_command(o, source.name)},
                    {"Scene SHA-256", source.hash}};
    return out;
}

std::vector<Device> devices_of(const RenderOptions& o)
{
    const std::string selector = device_selector(o.device);
    std::vector<Device> devices = find_devices(selector);
    if (!o.quiet) {
        for (const Device& d : devices) fmt::print(stderr, "device {}\n", describe(d.info));
        if (devices.front().info.native && selector != "native" && devices.size() == 1)
            fmt::print(stderr,
                       "clucida: note: no OpenCL device is installed; `apt install pocl-opencl-icd` gives one for "
                       "the processor\n");
    }
    for (const Device& d : devices)
        if (o.precision == "double") require_double(d.info);
    return devices;
}

} // namespace clucida::host
