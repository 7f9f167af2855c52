/// A process of this program that answers questions: a line of JSON each, over pipes.
#pragma once

#include "host/child_process.h"
#include "host/errors.h"

#include <nlohmann/json.hpp>

namespace clucida::bench {

/// A worker had no answer in time.
struct TookTooLong : host::Failure {
    using host::Failure::Failure;
};

/// Ends with the object, at the latest after a moment of grace.
class WorkerProcess {
public:
    /// Starts this very program with the subcommand. name is for errors. @throws host::Failure
    WorkerProcess(std::string name, const std::string& subcommand, const host::Environment& environment);
    ~WorkerProcess();
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    /// Waits for the answer; for so many seconds at most, unless 0, after which the worker is ended.
    /// @throws what the worker says went wrong (host::Failure, host::UsageError, host::Interrupted), host::Failure if
    /// it died, TookTooLong, host::Interrupted
    nlohmann::json ask(const nlohmann::json& request, double most_seconds = 0);

private:
    std::string read_line(double most_seconds);
    int stop();
    [[noreturn]] void give_up(double seconds);
    [[noreturn]] void tell_death();

    std::string name_, received_;
    pid_t process_ = -1;
    int to_ = -1, from_ = -1;
};

/// The worker's side: answers each line of standard input by a line on standard output until the input ends. What
/// answer throws becomes an answer too. Whatever else writes to standard output goes to standard error.
/// @throws host::Failure
void serve(const std::function<nlohmann::json(const nlohmann::json& request)>& answer);

} // namespace clucida::bench
