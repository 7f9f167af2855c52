#include "host/sequence.h"

#include "host/errors.h"
#include "host/frame_deal.h"
#include "host/sequence_writer.h"
#include "host/stopwatch.h"
#include "scene/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>

namespace clucida::host {
namespace {

/// Frames that a device may be ahead of another: they wait, as pictures, for those before them.
constexpr std::size_t frames_ahead = 4;

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

/// Renders the frames that are not kept.
class SequenceRenderer {
public:
    SequenceRenderer(const SequenceJob& job, const SequencePlan& plan, std::span<Renderer> team,
                     const SequenceHooks& hooks)
        : job_(job), plan_(plan), team_(team), hooks_(hooks), writer_(job, plan, hooks), settings_(job.settings),
          needs_(plan.needs)
    {
        for (const PlannedFrame& frame : plan.frames)
            if (!frame.kept) todo_.push_back(&frame);
    }

    SequenceReport render()
    {
        std::vector<std::size_t> numbers(todo_.size());
        std::iota(numbers.begin(), numbers.end(), std::size_t{0});
        const bool several = std::ranges::count_if(team_, works) > 1 && job_.in_flight > 1 && numbers.size() > 1;
        if (several) { // the first tells how fast each is
            render_together({0});
            numbers.erase(numbers.begin());
            numbers = deal_out(numbers);
        }
        render_together(numbers);
        writer_.finish();
        report_.rendered = todo_.size();
        return report_;
    }

private:
    static bool works(const Renderer& renderer) { return renderer.failure.empty(); }

    std::shared_ptr<const CompiledFrame> compiled(std::size_t number)
    {
        const auto compile = [&] {
            return std::make_shared<const CompiledFrame>(job_.motion->compile(todo_[number]->frame));
        };
        if (plan_.moves) return compile();
        const std::lock_guard lock(mutex_);
        if (!still_) still_ = compile();
        return still_;
    }

    /// All devices share each frame, while the next is compiled.
    void render_together(const std::vector<std::size_t>& numbers)
    {
        using Next = std::future<std::shared_ptr<const CompiledFrame>>;
        const auto policy = plan_.moves && job_.in_flight > 1 ? std::launch::async : std::launch::deferred;
        const auto compile = [&](std::size_t i) {
            return i < numbers.size() ? std::async(policy, [&, i] { return compiled(numbers[i]); }) : Next();
        };
        Next next = compile(0);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const auto frame = next.get();
            next = compile(i + 1);
            writer_.add(render_frame_by(team_, numbers[i], *frame, settings_, needs_, 0));
        }
    }

    /// Each device renders whole frames. Returns those that are left for all together.
    std::vector<std::size_t> deal_out(const std::vector<std::size_t>& numbers)
    {
        std::vector<Renderer*> takers;
        std::vector<double> seconds;
        for (Renderer& r : team_) {
            if (!works(r) || !(r.sample_seconds.value_or(0) > 0)) continue;
            takers.push_back(&r);
            seconds.push_back(*r.sample_seconds * static_cast<double>(area(settings_.picture)) * settings_.samples);
        }
        std::vector<scene::Needs> needs(takers.size(), needs_);
        const auto render = [&](std::size_t taker, std::size_t number) {
            const auto frame = compiled(number);
            RenderSettings settings = settings_;
            RenderedFrame done;
            try {
                done = render_frame_by({takers[taker], 1}, number, *frame, settings, needs[taker], taker);
            } catch (const Failure& e) {
                throw TakerFailure(e.what());
            }
            writer_.add(std::move(done));
        };
        const auto failed = [&](std::size_t taker, const std::string& why) {
            takers[taker]->failure = why;
            const std::lock_guard lock(mutex_);
            notes_.push_back(fmt::format("a device failed, and the others took over: {}", why));
            fractions_[taker] = 0;
        };
        std::vector<std::size_t> left = deal_frames(numbers, seconds, frames_ahead * takers.size(), render, failed);
        for (const scene::Needs& n : needs) needs_ = unite(needs_, n);
        return left;
    }

    /// taker: whose part of the progress it is
    RenderedFrame render_frame_by(std::span<Renderer> team, std::size_t number, const CompiledFrame& compiled,
                                  RenderSettings& settings, scene::Needs& needs, std::size_t taker)
    {
        RenderedFrame out;
        out.report.planned = todo_[number];
        const auto progress = [&](double fraction) { tell_progress(taker, fraction); };
        for (const scene::Compiled& eye : compiled.eyes) {
            Frame frame = render_next(team, eye, settings, needs, {progress, hooks_.cancelled, {}});
            add_timings(out.report.timings, frame.timings);
            add(out.report.statistics, frame.statistics);
            std::ranges::move(frame.notes, std::back_inserter(out.report.notes));
            out.report.device = std::move(frame.device);
            out.eyes.push_back(std::move(frame.picture));
        }
        const std::lock_guard lock(mutex_);
        add_timings(report_.timings, out.report.timings);
        std::ranges::move(notes_, std::back_inserter(out.report.notes));
        notes_.clear();
        fractions_[taker] = 0;
        return out;
    }

    void tell_progress(std::size_t taker, double fraction)
    {
        const std::lock_guard lock(mutex_);
        fractions_[taker] = fraction;
        double sum = 0;
        for (const auto& [number, part] : fractions_) sum += part;
        if (hooks_.progress) hooks_.progress(sum);
    }

    const SequenceJob& job_;
    const SequencePlan& plan_;
    std::span<Renderer> team_;
    const SequenceHooks& hooks_;
    SequenceWriter writer_;
    RenderSettings settings_; ///< devices are measured for the first frame
    scene::Needs needs_;      ///< of all frames so far
    std::vector<const PlannedFrame*> todo_;
    std::mutex mutex_; ///< of what follows, and of hooks
    SequenceReport report_;
    std::shared_ptr<const CompiledFrame> still_; ///< where nothing moves, all frames
    std::map<std::size_t, double> fractions_;    ///< of the frame that each taker is at
    std::vector<std::string> notes_;             ///< for the next frame
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
    SequenceReport report = SequenceRenderer(job, plan, team, hooks).render();
    report.builds = builds_of(team) - builds_before;
    report.seconds = watch.seconds();
    return report;
}

} // namespace clucida::host
