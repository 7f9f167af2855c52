#include "host/render_frames.h"

#include "host/atomic_file.h"
#include "host/errors.h"
#include "host/interrupt.h"
#include "host/max_error.h"
#include "host/progress.h"
#include "host/render_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <iostream>
#include <numeric>

namespace clucida::host {
namespace {

void add_target(FrameTargets& targets, const RenderOptions& o, const std::string& file)
{
    const std::string name = o.format_out.empty() ? file : o.format_out;
    if (const auto film = film_format(name)) {
        if (targets.film) throw UsageError("--output names two films; expected one, and a picture's name besides");
        targets.film = FilmFile{file, *film};
    } else if (const auto format = file_format(name)) {
        if (targets.files)
            throw UsageError("--output names the pictures twice; expected one name, and a film's besides");
        targets.files = FrameFiles{FramePattern(file), *format};
    } else if (file == "-") {
        targets.files = FrameFiles{FramePattern(file), FileFormat::png};
    } else {
        throw UsageError(fmt::format("the ending of '{}' names no format of pictures or films; expected one of {}, {}",
                                     file, file_endings(), film_endings()));
    }
    if (file == "-" && ::isatty(STDOUT_FILENO))
        throw UsageError("pictures are not written to a terminal; redirect standard output");
}

std::vector<unsigned> frames_of(const FrameTargets& targets, unsigned total, const RenderOptions& o)
{
    std::vector<unsigned> frames;
    if (targets.named) {
        frames = *targets.named;
        for (const unsigned frame : frames)
            if (total > 0 && frame > total)
                throw UsageError(fmt::format("--frames names frame {}; the sequence has {}", frame, total));
    } else if (total > 0 && (targets.film || (targets.files && targets.files->pattern.has_number()))) {
        frames.resize(total);
        std::iota(frames.begin(), frames.end(), 1U);
    } else if (targets.film) {
        throw UsageError("the scene does not say how many frames it has; expected 'sequence { frames N }' in it, or "
                         "--frames or --frame-count");
    } else {
        frames = {1};
    }
    return o.shard.empty() ? frames : shard_of(frames, parse_shard(o.shard));
}

void require_folders(const SequencePlan& plan)
{
    std::string last;
    for (const PlannedFrame& frame : plan.frames) {
        for (const std::string& file : frame.files) {
            const std::string folder = std::filesystem::path(file).parent_path().string();
            if (file != "-" && (last.empty() || folder != last)) require_writable(file);
            last = folder;
        }
    }
}

std::vector<std::filesystem::path> files_to_write(const SequencePlan& plan, const SequenceJob& job)
{
    std::vector<std::filesystem::path> files;
    for (const PlannedFrame& frame : plan.frames)
        for (const std::string& file : frame.files)
            if (file != "-") files.emplace_back(file);
    if (job.film && job.film->file != "-") files.emplace_back(job.film->file);
    return files;
}

std::string described(const PlannedFrame& frame)
{
    std::string files;
    for (const std::string& file : frame.files) files += (files.empty() ? "" : ", ") + file;
    return files.empty() ? fmt::format("frame {}", frame.frame) : files;
}

void print_plan(const SequencePlan& plan)
{
    for (const PlannedFrame& frame : plan.frames)
        fmt::print("{:>7} {} {}\n", frame.frame, frame.kept ? "keep  " : "render", described(frame));
}

/// What standard error sees while frames are rendered: a bar on a terminal, else a line for each frame.
class SequenceProgress {
public:
    SequenceProgress(std::size_t frames, bool quiet) : frames_(frames), quiet_(quiet), bar_("frames", !quiet) {}

    void traced(double fraction)
    {
        const std::size_t done = done_;
        bar_.set_label(fmt::format("{} of {} frames, {:.2f}/s", done, frames_, rate(done)));
        bar_.update((static_cast<double>(done) + fraction) / static_cast<double>(frames_));
    }
    /// From the thread that writes.
    void finished(const FrameReport& report)
    {
        const std::size_t done = ++done_;
        tell_notes(report.notes, quiet_);
        const std::string faults = describe_faults(report.statistics);
        if (!faults.empty())
            fmt::print(stderr, "clucida: warning: frame {} has faults: {}\n", report.planned->frame, faults);
        if (quiet_ || bar_.shown()) return;
        const double left = static_cast<double>(frames_ - done) / rate(done);
        fmt::print(stderr, "{}: {} of {}, {:.2f} frames/s, {:.0f} s left\n", described(*report.planned), done, frames_,
                   rate(done), left);
    }

private:
    double rate(std::size_t done) const { return static_cast<double>(done) / std::max(watch_.seconds(), 1e-9); }

    std::size_t frames_;
    bool quiet_;
    ProgressBar bar_;
    Stopwatch watch_;
    std::atomic<std::size_t> done_{0};
};

nlohmann::ordered_json frame_json(const FrameReport& report)
{
    return {{"frame", report.planned->frame},
            {"files", report.planned->files},
            {"fingerprint", report.planned->fingerprint},
            {"device", report.device},
            {"seconds", {{"upload", report.timings.upload}, {"trace", report.timings.trace}}},
            {"statistics", statistics_json(report.statistics)}};
}

void print_json(const RenderOptions& o, const SequencePlan& plan, const SequenceReport& report,
                nlohmann::ordered_json frames, bool to_output)
{
    nlohmann::ordered_json j = {{"scene", o.scene.file},
                                {"samples", o.samples},
                                {"precision", o.precision},
                                {"frames", std::move(frames)},
                                {"rendered", report.rendered},
                                {"kept", plan.kept},
                                {"builds", report.builds},
                                {"frames_per_second", static_cast<double>(report.rendered) / report.seconds},
                                {"seconds",
                                 {{"total", report.seconds},
                                  {"build", report.timings.build},
                                  {"first_launch", report.timings.first_enqueue},
                                  {"upload", report.timings.upload},
                                  {"trace", report.timings.trace}}}};
    if (o.max_error) j["max_error"] = error_choice_json(o);
    (to_output ? std::cerr : std::cout) << j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

} // namespace

FrameTargets frame_targets(const RenderOptions& o)
{
    FrameTargets targets;
    if (o.frames) targets.named = parse_frames(*o.frames, &targets.repeated);
    targets.several = targets.named || !o.shard.empty() || o.dry_run || o.outputs.size() > 1;
    if (o.outputs.size() > 1 && !o.format_out.empty())
        throw UsageError("--format-out is for one --output; of several the endings say which format");
    const bool stereo = !o.stereo.empty();
    for (const std::string& file : o.outputs) {
        try {
            add_target(targets, o, file);
        } catch (const UsageError&) {
            if (targets.several || stereo) throw; // else it is a single picture, whose name means what it says
        }
    }
    targets.several = targets.several || targets.film;
    return targets;
}

bool is_sequence(const FrameTargets& targets, const scene::Sequence& sequence, const RenderOptions& o)
{
    const bool numbered = targets.files && targets.files->pattern.has_number();
    return targets.several || (numbered && (sequence.frames > 1 || o.scene.moment.frames > 1));
}

void render_frames(const RenderOptions& o, SceneSource source, const FrameTargets& targets)
{
    SequenceJob job;
    job.files = targets.files;
    job.film = targets.film;
    if (!job.files && !job.film) {
        const std::string ending = o.format_out.empty() ? "png" : o.format_out;
        job.files = FrameFiles{FramePattern(source.stem + "." + ending), file_format(ending).value_or(FileFormat::png)};
    }
    const unsigned count = o.scene.moment.frames, total = count ? count : source.scene.sequence.frames;
    job.frames = frames_of(targets, total, o);
    job.settings = settings_of(o);
    job.fps = source.scene.sequence.fps;
    job.skip_existing = o.skip_existing;
    job.in_flight = o.in_flight;
    job.encoding = encoding_of(o, source);
    const Stereo stereo = stereo_of(o);
    if (job.film && stereo.layout == StereoLayout::pair)
        throw UsageError("a film has one picture a frame; expected --stereo side-by-side, top-bottom or anaglyph");
    const Shape size = composed_size(stereo.layout, job.settings.picture);
    if (job.files) require_encodable(size.width, size.height, job.files->format, job.encoding);
    if (job.film) require_filmable(size, job.film->format);
    if (targets.repeated && !o.quiet)
        fmt::print(stderr, "clucida: note: --frames names {} frames again; each is rendered once\n", targets.repeated);
    if (job.frames.empty()) {
        if (!o.quiet) fmt::print(stderr, "no frame falls to this shard\n");
        return;
    }

    const scene::View view = view_of(o, source);
    SceneOptions options = o.scene;
    options.moment.frames = total;
    source.scene = {};
    const Motion motion(std::move(source), options, view, stereo);
    job.motion = &motion;
    const SequencePlan plan = plan_sequence(job, interrupted);
    if (o.dry_run) return print_plan(plan);
    require_folders(plan);
    const std::size_t todo = plan.frames.size() - plan.kept;
    if (!o.quiet && !plan.moves && plan.frames.size() > 1)
        fmt::print(stderr, "clucida: note: the scene depends neither on t nor on frame; all pictures are the same\n");
    if (!o.quiet && plan.kept) fmt::print(stderr, "{} of {} frames are kept\n", plan.kept, plan.frames.size());

    remove_leftovers(files_to_write(plan, job));
    std::vector<Renderer> team;
    if (todo > 0) {
        const std::vector<Device> devices = devices_of(o);
        team = make_renderers(devices);
        job.encoding.metadata.emplace_back("Device", describe(devices));
    }
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    SequenceReport report;
    {
        SequenceProgress progress(todo, o.quiet);
        report = render_sequence(job, plan, team,
                                 {[&](double fraction) { progress.traced(fraction); }, interrupted,
                                  [&](const FrameReport& done) {
                                      progress.finished(done);
                                      if (o.json) frames.push_back(frame_json(done));
                                  }});
    }
    if (!o.quiet)
        fmt::print(stderr, "{} frame{} in {:.2f} s, {:.2f} frames/s, {} build{} of the kernels{}\n", report.rendered,
                   report.rendered == 1 ? "" : "s", report.seconds,
                   static_cast<double>(report.rendered) / report.seconds, report.builds, report.builds == 1 ? "" : "s",
                   job.film ? fmt::format("; {}", job.film->file) : "");
    const bool to_output = (job.film && job.film->file == "-") || (job.files && job.files->pattern.file(1) == "-");
    if (o.json) print_json(o, plan, report, std::move(frames), to_output);
}

} // namespace clucida::host
