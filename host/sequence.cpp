#include "host/sequence.h"

#include "host/atomic_file.h"
#include "host/errors.h"
#include "host/stopwatch.h"
#include "host/work_queue.h"
#include "scene/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <future>
#include <mutex>
#include <set>
#include <thread>

namespace clucida::host {
namespace {

/// Threads that plan: a text so large that its frames fill the memory is read by one.
constexpr std::size_t large_text = std::size_t{1} << 24;

std::vector<std::string> files_of(const SequenceJob& job, unsigned frame)
{
    if (!job.files) return {};
    const std::string file = job.files->pattern.file(frame);
    if (job.motion->stereo().layout != StereoLayout::pair) return {file};
    return {eye_file(file, 0), eye_file(file, 1)};
}

void require_different_files(const SequencePlan& plan)
{
    std::set<std::string> known;
    for (const PlannedFrame& frame : plan.frames)
        for (const std::string& file : frame.files)
            if (file != "-" && !known.insert(file).second)
                throw UsageError(fmt::format("several frames would be written to {}; expected a name with a place for "
                                             "the frame's number, such as %04d or ####",
                                             file));
}

/// Whether a frame's files are those that would be rendered.
bool is_kept(const SequenceJob& job, const PlannedFrame& planned)
{
    return job.files && job.skip_existing && std::ranges::all_of(planned.files, [&](const std::string& file) {
               return is_same_picture(file, planned.fingerprint);
           });
}

scene::Needs needs_of(const CompiledFrame& compiled)
{
    scene::Needs needs = compiled.eyes.front().needs;
    for (const scene::Compiled& eye : compiled.eyes) needs = unite(needs, eye.needs);
    return needs;
}

/// Does `work` for each index below count, on several threads; what the least index threw is thrown.
void for_each_index(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work)
{
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::size_t failed = count;
    std::exception_ptr failure;
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                work(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (i < failed) failure = std::current_exception();
                failed = std::min(failed, i);
                next = count;
            }
        }
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads && i < count; ++i) others.emplace_back(run);
    run();
    for (std::thread& thread : others) thread.join();
    if (failure) std::rethrow_exception(failure);
}

void add_timings(Timings& sum, const Timings& t)
{
    sum.build += t.build;
    sum.first_enqueue += t.first_enqueue;
    sum.upload += t.upload;
    sum.trace += t.trace;
    sum.trace_cpu += t.trace_cpu;
    sum.kernels += t.kernels;
    sum.rows += t.rows;
}

unsigned builds_of(std::span<const Renderer> team)
{
    unsigned sum = 0;
    for (const Renderer& r : team) sum += r.builds;
    return sum;
}

/// Writes finished frames, in order.
class Writer {
public:
    Writer(const SequenceJob& job, const SequenceHooks& hooks) : job_(job), hooks_(hooks)
    {
        if (!job.film) return;
        const scene::View& view = job.motion->view();
        size_ = composed_size(job.motion->stereo().layout, {view.width, view.height});
        film_.emplace(job.film->file, job.film->format, size_, job.fps);
    }

    /// Pictures of one frame: of each eye.
    void write(FrameReport report, std::vector<Picture> eyes)
    {
        const PlannedFrame& planned = *report.planned;
        std::vector<Picture> pictures;
        if (planned.files.size() == 2)
            pictures = std::move(eyes);
        else
            pictures.push_back(compose(job_.motion->stereo().layout, std::move(eyes)));
        for (std::size_t i = 0; i < planned.files.size(); ++i) {
            EncodeOptions encoding = job_.encoding;
            encoding.metadata.emplace_back("Frame", fmt::format("{}", planned.frame));
            encoding.metadata.emplace_back(fingerprint_keyword, planned.fingerprint);
            const std::string bytes = encode(pictures[i], job_.files->format, encoding);
            if (planned.files[i] == "-")
                write_all(STDOUT_FILENO, bytes, "standard output");
            else
                write_file(planned.files[i], bytes);
        }
        if (film_) film_->add(develop_8(pictures[0], job_.encoding.transfer));
        if (hooks_.finished) hooks_.finished(report);
    }

    /// A frame whose file is kept.
    void keep(const PlannedFrame& planned)
    {
        if (!film_) return;
        const Picture picture = read_picture(planned.files[0], job_.encoding.transfer);
        if (picture.width != size_.width || picture.height != size_.height)
            throw Failure(fmt::format("{} has changed while it was used", planned.files[0]));
        film_->add(develop_8(picture, job_.encoding.transfer));
    }

    void finish()
    {
        if (film_) film_->finish();
    }

private:
    const SequenceJob& job_;
    const SequenceHooks& hooks_;
    std::optional<Film> film_;
    Shape size_;
};

} // namespace

SequencePlan plan_sequence(const SequenceJob& job, const std::function<bool()>& cancelled)
{
    SequencePlan plan;
    for (const unsigned frame : job.frames) plan.frames.push_back({frame, files_of(job, frame), "", false});
    require_different_files(plan);
    if (plan.frames.empty()) return plan;

    Fingerprints fingerprints;
    const auto fingerprint_of = [&](const CompiledFrame& frame) {
        if (!job.files) return std::string();
        return fingerprints.of(frame, job.settings.precision, job.motion->stereo().layout, job.files->format,
                               job.encoding);
    };
    const CompiledFrame first = job.motion->compile(job.frames.front());
    plan.moves = first.moves;
    const std::string first_fingerprint = fingerprint_of(first);
    std::vector<scene::Needs> needs(plan.frames.size(), needs_of(first));
    const bool large = job.motion->source().text.text.size() > large_text;
    for_each_index(plan.frames.size(), large ? 1 : std::thread::hardware_concurrency(), [&](std::size_t i) {
        if (cancelled && cancelled()) throw Interrupted();
        PlannedFrame& frame = plan.frames[i];
        frame.fingerprint = first_fingerprint;
        if (i > 0 && first.moves) {
            const CompiledFrame compiled = job.motion->compile(frame.frame);
            needs[i] = needs_of(compiled);
            frame.fingerprint = fingerprint_of(compiled);
        }
        frame.kept = is_kept(job, frame);
    });
    std::optional<scene::Needs> all;
    for (std::size_t i = 0; i < plan.frames.size(); ++i) {
        if (plan.frames[i].kept)
            ++plan.kept;
        else
            all = all ? unite(*all, needs[i]) : needs[i];
    }
    plan.needs = all.value_or(needs.front());
    return plan;
}

SequenceReport render_sequence(const SequenceJob& job, const SequencePlan& plan, std::span<Renderer> team,
                               const SequenceHooks& hooks)
{
    const Stopwatch watch;
    const unsigned builds_before = builds_of(team);
    SequenceReport report;
    RenderSettings settings = job.settings;
    scene::Needs needs = plan.needs;
    std::vector<const PlannedFrame*> todo;
    for (const PlannedFrame& frame : plan.frames)
        if (!frame.kept) todo.push_back(&frame);

    const bool overlaps = job.in_flight > 1;
    const auto compile = [&](std::size_t i) {
        return std::async(overlaps ? std::launch::async : std::launch::deferred,
                          [&job, frame = todo[i]->frame] { return job.motion->compile(frame); });
    };
    Writer writer(job, hooks);
    std::future<CompiledFrame> next; // before the queue, which is done with before it
    WorkQueue queue(overlaps ? job.in_flight - 1 : 0);
    std::shared_ptr<const CompiledFrame> compiled;
    std::size_t at = 0;
    for (const PlannedFrame& planned : plan.frames) {
        if (planned.kept) {
            queue.push([&writer, &planned] { writer.keep(planned); });
            continue;
        }
        if (!compiled || plan.moves) {
            if (!next.valid()) next = compile(at);
            compiled = std::make_shared<const CompiledFrame>(next.get());
        }
        ++at;
        if (plan.moves && at < todo.size()) next = compile(at);
        FrameReport done;
        done.planned = &planned;
        auto eyes = std::make_shared<std::vector<Picture>>();
        for (const scene::Compiled& eye : compiled->eyes) {
            Frame frame = render_next(team, eye, settings, needs, {hooks.progress, hooks.cancelled, {}});
            add_timings(done.timings, frame.timings);
            add(done.statistics, frame.statistics);
            std::ranges::move(frame.notes, std::back_inserter(done.notes));
            eyes->push_back(std::move(frame.picture));
        }
        add_timings(report.timings, done.timings);
        ++report.rendered;
        queue.push([&writer, done, eyes] { writer.write(done, std::move(*eyes)); });
    }
    queue.finish();
    writer.finish();
    report.builds = builds_of(team) - builds_before;
    report.seconds = watch.seconds();
    return report;
}

} // namespace clucida::host
