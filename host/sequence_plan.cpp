#include "host/sequence_plan.h"

#include "host/errors.h"
#include "host/fingerprint.h"
#include "host/share_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
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
    std::atomic<std::size_t> failed{count}; // the least
    std::mutex mutex;
    std::exception_ptr failure;
    const auto most = static_cast<unsigned>(std::min<std::size_t>(threads, count));
    share_work(count, most, [&](std::size_t i, unsigned) {
        if (i > failed) return;
        try {
            work(i);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (i > failed) return;
            failed = i;
            failure = std::current_exception();
        }
    });
    if (failure) std::rethrow_exception(failure);
}

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

} // namespace clucida::host
