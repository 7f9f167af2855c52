/// Other programs, started without a shell.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

namespace clucida::host {

using Environment = std::map<std::string, std::string>;

/// Descriptors that become the child's standard input, output and error; -1: those of this process.
struct StandardFiles {
    int in = -1, out = -1, err = -1;
};

/// Starts command[0], looked for as a shell would, with the rest as its arguments; environment is what differs from
/// this process's. @throws Failure
pid_t start_child(const std::vector<std::string>& command, const Environment& environment, const StandardFiles& files);

/// "exit code 1", "signal 11 (Segmentation fault)": what waitpid() says of a child that ended.
std::string describe_end(int status);

/// Runs a program to its end with its output and errors going to a file. True if it succeeded. @throws Failure
bool run_child(const std::vector<std::string>& command, const std::string& output_file);

} // namespace clucida::host
