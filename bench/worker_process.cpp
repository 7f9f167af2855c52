#include "bench/worker_process.h"

#include "host/atomic_file.h"
#include "host/errors.h"
#include "host/interrupt.h"
#include "host/opencl.h"
#include "host/stopwatch.h"
#include "scene/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <thread>

namespace clucida::bench {
namespace {

constexpr int patience = 100;  ///< ms between looks at the user's wish to stop
constexpr double grace = 5;    ///< s that a worker has for its end
constexpr int no_answer = 256; ///< no status that waitpid() gives

std::array<int, 2> make_pipe()
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw host::Failure("cannot make a pipe");
    return ends;
}

std::string this_program()
{
    return std::filesystem::read_symlink("/proc/self/exe").string();
}

std::string dumped(const nlohmann::json& j)
{
    return j.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

nlohmann::json failed(const std::exception& e, int code)
{
    return {{"error", e.what()}, {"code", code}};
}

nlohmann::json answer_or_error(const std::function<nlohmann::json(const nlohmann::json&)>& answer,
                               const std::string& line)
{
    try {
        return answer(nlohmann::json::parse(line));
    } catch (const scene::Error& e) {
        return failed(e, host::exit_usage);
    } catch (const host::UsageError& e) {
        return failed(e, host::exit_usage);
    } catch (const host::Interrupted& e) {
        return failed(e, host::exit_interrupted);
    } catch (const cl::Error& e) {
        return {{"error", host::explain(e)}, {"code", host::exit_failed}};
    } catch (const std::exception& e) {
        return failed(e, host::exit_failed);
    }
}

} // namespace

WorkerProcess::WorkerProcess(std::string name, const std::string& subcommand, const host::Environment& environment)
    : name_(std::move(name))
{
    const std::array<int, 2> questions = make_pipe(), answers = make_pipe();
    to_ = questions[1];
    from_ = answers[0];
    try {
        process_ = host::start_child({this_program(), subcommand}, environment, {questions[0], answers[1], -1});
    } catch (...) {
        for (const int end : {questions[0], questions[1], answers[0], answers[1]}) ::close(end);
        throw;
    }
    ::close(questions[0]);
    ::close(answers[1]);
}

WorkerProcess::~WorkerProcess()
{
    stop();
    ::close(from_);
}

/// Lets it end, or ends it; no zombie is left. How it ended.
int WorkerProcess::stop()
{
    if (process_ < 0) return no_answer;
    ::close(to_);
    int status = 0;
    const host::Stopwatch watch;
    for (;;) {
        const pid_t ended = ::waitpid(process_, &status, WNOHANG);
        if (ended == process_ || (ended < 0 && errno != EINTR)) break;
        if (watch.seconds() > grace) ::kill(process_, SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    process_ = -1;
    return status;
}

void WorkerProcess::tell_death()
{
    throw host::Failure(fmt::format("{}: the process that rendered it ended: {}", name_, host::describe_end(stop())));
}

void WorkerProcess::give_up(double seconds)
{
    ::kill(process_, SIGKILL);
    stop();
    throw TookTooLong(fmt::format("{}: took longer than {:g} s", name_, seconds));
}

std::string WorkerProcess::read_line(double most_seconds)
{
    const host::Stopwatch watch;
    for (;;) {
        if (const auto end = received_.find('\n'); end != std::string::npos) {
            std::string line = received_.substr(0, end);
            received_.erase(0, end + 1);
            return line;
        }
        pollfd answers{from_, POLLIN, 0};
        const int ready = ::poll(&answers, 1, patience);
        if (host::interrupted()) throw host::Interrupted();
        if (ready <= 0 && most_seconds > 0 && watch.seconds() > most_seconds) give_up(most_seconds);
        if (ready <= 0) continue;
        std::array<char, 1 << 16> piece;
        const ssize_t n = ::read(from_, piece.data(), piece.size());
        if (n > 0)
            received_.append(piece.data(), static_cast<std::size_t>(n));
        else if (n == 0 || errno != EINTR)
            tell_death();
    }
}

nlohmann::json WorkerProcess::ask(const nlohmann::json& request, double most_seconds)
{
    if (process_ < 0) throw host::Failure(name_ + ": the process that rendered it has ended");
    try {
        host::write_all(to_, dumped(request), name_);
    } catch (const host::Failure&) {
        tell_death();
    }
    nlohmann::json answer = nlohmann::json::parse(read_line(most_seconds));
    const auto error = answer.find("error");
    if (error == answer.end()) return answer;
    const std::string what = fmt::format("{}: {}", name_, error->get<std::string>());
    switch (answer.at("code").get<int>()) {
    case host::exit_usage: throw host::UsageError(what);
    case host::exit_interrupted: throw host::Interrupted();
    default: throw host::Failure(what);
    }
}

void serve(const std::function<nlohmann::json(const nlohmann::json& request)>& answer)
{
    const int answers = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (answers < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
        throw host::Failure("standard output cannot be had for answers");
    for (std::string line; std::getline(std::cin, line);)
        host::write_all(answers, dumped(answer_or_error(answer, line)), "the answer");
    ::close(answers);
}

} // namespace clucida::bench
