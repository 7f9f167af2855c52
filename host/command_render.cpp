#include "host/arguments.h"
#include "host/commands.h"
#include "host/errors.h"
#include "host/fingerprint.h"
#include "host/interrupt.h"
#include "host/max_error.h"
#include "host/progress.h"
#include "host/render_frames.h"
#include "host/render_options.h"
#include "host/render_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

namespace clucida::host {
namespace {

/// Scenes of more bytes get no fingerprint unless it is asked for, for that takes a while.
constexpr std::size_t most_fingerprinted = std::size_t{1} << 25;

void report(const RenderOptions& o, const Output& output, const Frame& frame, const Stages& stages)
{
    tell_notes(frame.notes, o.quiet);
    const std::string faults = describe_faults(frame.statistics);
    if (!faults.empty()) fmt::print(stderr, "clucida: warning: the picture has faults: {}\n", faults);
    if (!o.quiet) fmt::print(stderr, "{}\n", timing_line(output.file, frame, o.samples, stages));
    if (!o.json) return;
    nlohmann::ordered_json j = {
        {"scene", o.scene.file}, {"output", output.file}, {"samples", o.samples}, {"precision", o.precision}};
    if (o.max_error) j["max_error"] = error_choice_json(o);
    j.update(frame_json(frame, stages));
    auto& stream = output.file == "-" ? std::cerr : std::cout;
    stream << j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

/// One picture, whose rows go to the file as they come.
void render_still(const RenderOptions& o, SceneSource source, const Output& output, const Stopwatch& total,
                  Stages stages)
{
    const RenderSettings settings = settings_of(o);
    EncodeOptions encoding = encoding_of(o, source);
    require_encodable(settings.picture.width, settings.picture.height, output.format, encoding);
    Stopwatch watch;
    CompiledFrame frame_scene;
    frame_scene.eyes.push_back(compile_scene(source, view_of(o, source)));
    const scene::Compiled& compiled = frame_scene.eyes.front();
    source.scene = {}; // a million objects are some hundred MiB, which tracing need not keep
    source.text = {};
    std::string fingerprint;
    if (output.file != "-" && (o.skip_existing || scene::byte_count(compiled.buffers) <= most_fingerprinted)) {
        fingerprint = Fingerprints().of(frame_scene, settings.precision, StereoLayout::none, output.format, encoding);
        if (o.skip_existing && is_same_picture(output.file, fingerprint)) {
            if (!o.quiet) fmt::print(stderr, "{} is whole and would be the same, kept\n", output.file);
            return;
        }
    }
    stages.compile = watch.lap();
    const std::vector<Device> devices = devices_of(o);
    encoding.metadata.emplace_back("Device", describe(devices));
    encoding.metadata.emplace_back("Frame", fmt::format("{}", o.scene.moment.frame));
    if (!fingerprint.empty()) encoding.metadata.emplace_back(fingerprint_keyword, fingerprint);
    stages.devices += watch.lap();

    std::vector<Renderer> team = make_renderers(devices);
    stages.context = watch.lap();
    if (output.file != "-") remove_leftovers({output.file});
    OutputStream stream(output, settings.picture, encoding);
    Frame frame;
    {
        ProgressBar bar(output.file, !o.quiet);
        frame = render_frame(team, compiled, settings,
                             {[&](double done) { bar.update(done); }, interrupted,
                              [&](unsigned y, std::span<const float> rgb) { stream.add(y, rgb); }});
    }
    watch.lap();
    stream.commit(interrupted);
    stages.write = watch.lap();
    stages.total = total.seconds();
    report(o, output, frame, stages);
}

void run(RenderOptions o)
{
    const Stopwatch total;
    settings_of(o); // what is wrong with the options is said before the scene is read
    const FrameTargets targets = frame_targets(o);
    if (targets.named) o.scene.moment.frame = targets.named->front();
    const std::string stem = o.scene.file == "-" ? "picture" : std::filesystem::path(o.scene.file).stem().string();
    std::optional<Output> still;
    if (!targets.several && o.stereo.empty())
        still = choose_output(o.outputs.empty() ? "" : o.outputs.front(), o.format_out, stem);

    Stopwatch watch;
    Stages stages;
    SceneSource source = load_scene(o.scene);
    stages.read = watch.lap();
    choose_by_error(o, source.hash);
    if (o.max_error) stages.devices = watch.lap();
    if (still && !is_sequence(targets, source.scene.sequence, o))
        return render_still(o, std::move(source), *still, total, stages);
    render_frames(o, std::move(source), targets);
}

} // namespace

void add_render(CLI::App& app)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        app.add_subcommand("render", "Render a scene to a picture, or frames of it to pictures or a film");
    add_render_options(*command, *options);
    command->footer("Examples:\n"
                    "  clucida render scene.clu\n"
                    "  clucida render scene.clu -o out.hdr -s 1920x1080 --samples 64\n"
                    "  clucida render scene.clu -o out.png --max-error 0.01\n"
                    "  clucida render scene.clu -o - --format-out ppm | ffmpeg -i - out.webp\n"
                    "  clucida render scene.clu -o frames/%04d.png -o film.mp4 --skip-existing\n"
                    "  clucida render scene.clu -o frames/####.png --frames 1-100 --shard 2/4\n"
                    "  clucida render scene.clu -o - --format-out y4m | ffmpeg -i - film.webm\n"
                    "\nThe environment's CLUCIDA_DEVICE chooses like --device.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::host
