/// Rendered frames become files and a film, in order, in a thread of its own.
#pragma once

#include "host/sequence.h"
#include "host/work_queue.h"

#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

namespace clucida::host {

/// A frame's report, and its pictures: of each eye.
struct RenderedFrame {
    FrameReport report;
    std::vector<Picture> eyes;
};

class SequenceWriter {
public:
    SequenceWriter(const SequenceJob& job, const SequencePlan& plan, const SequenceHooks& hooks);
    /// Where the work has ended early, frames that waited for an earlier one are written without it; a film is not.
    ~SequenceWriter();
    SequenceWriter(const SequenceWriter&) = delete;
    SequenceWriter& operator=(const SequenceWriter&) = delete;

    /// From any thread; waits while too many frames are in flight. @throws what writing an earlier one has thrown
    void add(RenderedFrame frame);
    /// All frames are there: waits until they are written.
    void finish();

private:
    void push_next();
    void write(RenderedFrame frame);
    void write_files(const FrameReport& report, const std::vector<Picture>& pictures);
    void keep(const PlannedFrame& planned);

    const SequenceJob& job_;
    const SequencePlan& plan_;
    const SequenceHooks& hooks_;
    std::optional<Film> film_;
    Shape size_;
    std::mutex mutex_; ///< of what follows
    std::map<const PlannedFrame*, RenderedFrame> waiting_;
    std::size_t next_ = 0;                ///< of the plan's frames: the first that was not pushed
    std::atomic<bool> abandoned_ = false; ///< the film is
    std::optional<WorkQueue> queue_;
};

} // namespace clucida::host
