#include "host/work_queue.h"

#include <utility>

namespace clucida::host {

WorkQueue::WorkQueue(std::size_t most) : most_(most)
{
    if (most > 0) thread_ = std::thread([this] { work(); });
}

WorkQueue::~WorkQueue()
{
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void WorkQueue::push(std::function<void()> job)
{
    if (most_ == 0) return job();
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return jobs_.size() < most_ || failure_; });
        throw_failure();
        jobs_.push_back(std::move(job));
    }
    changed_.notify_all();
}

void WorkQueue::finish()
{
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return jobs_.empty() || failure_; });
    throw_failure();
}

void WorkQueue::throw_failure()
{
    if (failure_) std::rethrow_exception(failure_);
}

void WorkQueue::work()
{
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return !jobs_.empty() || ended_; });
        if (jobs_.empty() || failure_) return;
        const auto& job = jobs_.front();
        lock.unlock();
        std::exception_ptr failure;
        try {
            job();
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        failure_ = failure;
        jobs_.pop_front();
        changed_.notify_all();
    }
}

} // namespace clucida::host
