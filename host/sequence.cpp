#include "host/sequence.h"

#include "host/errors.h"
#include "host/frame_deal.h"
#include "host/sequence_writer.h"
#include "host/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>

namespace clucida::host {
namespace {

/// Frames that a device may be ahead of another: they wait, as pictures, for those before them.
constexpr std::size_t frames_ahead = 4;

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
