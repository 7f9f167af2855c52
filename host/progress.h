/// A progress bar on standard error, where that is a terminal.
#pragma once

#include "host/stopwatch.h"

#include <string>

namespace clucida::host {

class ProgressBar {
public:
    /// Shown only if `wanted` and standard error is a terminal.
    ProgressBar(std::string label, bool wanted);
    ~ProgressBar(); ///< removes the bar
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    bool shown() const { return shown_; }
    void set_label(const std::string& label) { label_ = label; }
    void update(double fraction); ///< 0..1

private:
    std::string label_;
    bool shown_;
    double last_ = -1; ///< s, when it was drawn
    Stopwatch watch_;
};

} // namespace clucida::host
