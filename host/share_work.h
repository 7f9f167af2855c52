/// Work in pieces that do not depend on one another, done by several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace clucida::host {

/// Calls work(item, worker) once for each item below count. Workers are numbered below threads (at least 1), and the
/// caller's thread is one of them; what a worker calls must not throw.
template <class Work>
void share_work(std::size_t count, unsigned threads, const Work& work)
{
    std::atomic<std::size_t> next{0};
    const auto take = [&](unsigned worker) {
        for (std::size_t i = next++; i < count; i = next++) work(i, worker);
    };
    std::vector<std::jthread> team;
    for (unsigned worker = 1; worker < threads; worker++) team.emplace_back(take, worker);
    take(0);
}

} // namespace clucida::host
