/// What can go wrong on the host, by the exit code it leads to. Scenes have scene::Error (2).
#pragma once

#include <stdexcept>

namespace clucida::host {

/// Exit codes of the programs.
enum Exit { exit_done = 0, exit_failed = 1, exit_usage = 2, exit_interrupted = 130 };

/// No device, a failed build, input or output: exit 1.
struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Something was asked for that makes no sense: exit 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The user asked to stop: exit 130.
struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted") {}
};

} // namespace clucida::host
