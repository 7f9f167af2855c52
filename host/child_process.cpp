#include "host/child_process.h"

#include "host/errors.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace clucida::host {
namespace {

class FileActions {
public:
    FileActions() { ::posix_spawn_file_actions_init(&actions_); }
    ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;

    void become(int descriptor, int standard)
    {
        if (descriptor >= 0) ::posix_spawn_file_actions_adddup2(&actions_, descriptor, standard);
    }
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

std::vector<std::string> merged(const Environment& changes)
{
    std::vector<std::string> out;
    for (char** entry = environ; *entry; ++entry) {
        const std::string text = *entry;
        if (!changes.contains(text.substr(0, text.find('=')))) out.push_back(text);
    }
    for (const auto& [name, value] : changes) out.push_back(fmt::format("{}={}", name, value));
    return out;
}

std::vector<char*> pointers(std::vector<std::string>& texts)
{
    std::vector<char*> out;
    out.reserve(texts.size() + 1);
    for (std::string& text : texts) out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

} // namespace

pid_t start_child(const std::vector<std::string>& command, const Environment& environment, const StandardFiles& files)
{
    std::vector<std::string> arguments = command, variables = merged(environment);
    FileActions actions;
    actions.become(files.in, STDIN_FILENO);
    actions.become(files.out, STDOUT_FILENO);
    actions.become(files.err, STDERR_FILENO);
    pid_t child = -1;
    const int error = ::posix_spawnp(&child, command.front().c_str(), actions.get(), nullptr,
                                     pointers(arguments).data(), pointers(variables).data());
    if (error) throw Failure(fmt::format("cannot start {}: {}", command.front(), std::strerror(error)));
    return child;
}

std::string describe_end(int status)
{
    if (WIFSIGNALED(status)) return fmt::format("signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
    return fmt::format("exit code {}", WEXITSTATUS(status));
}

bool run_child(const std::vector<std::string>& command, const std::string& output_file)
{
    const int output = ::open(output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (output < 0) throw Failure(fmt::format("cannot write {}: {}", output_file, std::strerror(errno)));
    pid_t child = -1;
    try {
        child = start_child(command, {}, {-1, output, output});
    } catch (...) {
        ::close(output);
        throw;
    }
    ::close(output);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace clucida::host
