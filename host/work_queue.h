/// Jobs that a thread of their own does one after the other, while others are made.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace clucida::host {

class WorkQueue {
public:
    /// At most so many jobs wait or are being done; with none, push does its job itself.
    explicit WorkQueue(std::size_t most);
    ~WorkQueue(); ///< does what waits, unless a job has failed
    WorkQueue(const WorkQueue&) = delete;
    WorkQueue& operator=(const WorkQueue&) = delete;

    /// Waits until there is room. Once a job has thrown, throws the same, and no other job is begun.
    void push(std::function<void()> job);
    /// Waits until all jobs are done. @throws what a job has thrown
    void finish();

private:
    void work();
    void throw_failure();

    std::size_t most_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_; ///< the first is being done
    std::exception_ptr failure_;
    bool ended_ = false;
    std::thread thread_;
};

} // namespace clucida::host
