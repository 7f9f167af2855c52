#include "host/sequence_writer.h"

#include "host/atomic_file.h"
#include "host/errors.h"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <utility>

namespace clucida::host {

SequenceWriter::SequenceWriter(const SequenceJob& job, const SequencePlan& plan, const SequenceHooks& hooks)
    : job_(job), plan_(plan), hooks_(hooks)
{
    if (job.film) {
        const scene::View& view = job.motion->view();
        size_ = composed_size(job.motion->stereo().layout, {view.width, view.height});
        film_.emplace(job.film->file, job.film->format, size_, job.fps);
    }
    queue_.emplace(job.in_flight - 1);
}

SequenceWriter::~SequenceWriter()
{
    abandoned_ = !waiting_.empty();
    try {
        for (auto& [planned, frame] : waiting_) {
            const auto shared = std::make_shared<RenderedFrame>(std::move(frame));
            queue_->push([this, shared] { write(std::move(*shared)); });
        }
    } catch (...) { // another exception is on its way already
    }
    queue_.reset();
}

void SequenceWriter::add(RenderedFrame frame)
{
    const std::lock_guard lock(mutex_);
    const PlannedFrame* const planned = frame.report.planned;
    waiting_.emplace(planned, std::move(frame));
    push_next();
}

void SequenceWriter::finish()
{
    {
        const std::lock_guard lock(mutex_);
        push_next();
    }
    queue_->finish();
    if (film_) film_->finish();
}

/// Hands over what has no gap before it.
void SequenceWriter::push_next()
{
    for (; next_ < plan_.frames.size(); ++next_) {
        const PlannedFrame& planned = plan_.frames[next_];
        if (planned.kept) {
            queue_->push([this, &planned] { keep(planned); });
            continue;
        }
        const auto found = waiting_.find(&planned);
        if (found == waiting_.end()) return;
        const auto frame = std::make_shared<RenderedFrame>(std::move(found->second));
        waiting_.erase(found);
        queue_->push([this, frame] { write(std::move(*frame)); });
    }
}

void SequenceWriter::write(RenderedFrame frame)
{
    std::vector<Picture> pictures;
    if (frame.report.planned->files.size() == 2)
        pictures = std::move(frame.eyes);
    else
        pictures.push_back(compose(job_.motion->stereo().layout, std::move(frame.eyes)));
    write_files(frame.report, pictures);
    if (film_ && !abandoned_) film_->add(develop_8(pictures[0], job_.encoding.transfer));
    if (hooks_.finished) hooks_.finished(frame.report);
}

void SequenceWriter::write_files(const FrameReport& report, const std::vector<Picture>& pictures)
{
    const PlannedFrame& planned = *report.planned;
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
}

/// A frame whose file is kept.
void SequenceWriter::keep(const PlannedFrame& planned)
{
    if (!film_) return;
    const Picture picture = read_picture(planned.files[0], job_.encoding.transfer);
    if (picture.width != size_.width || picture.height != size_.height)
        throw Failure(fmt::format("{} has changed while it was used", planned.files[0]));
    film_->add(develop_8(picture, job_.encoding.transfer));
}

} // namespace clucida::host
