/// Time since their making: by the clock, and by the processor.
#pragma once

#include <chrono>
#include <ctime>

namespace clucida::host {

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    /// And begins anew.
    double lap()
    {
        const double passed = seconds();
        start_ = std::chrono::steady_clock::now();
        return passed;
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The time that all threads of this process computed.
class CpuStopwatch {
public:
    double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
    std::clock_t start_ = std::clock();
};

} // namespace clucida::host
