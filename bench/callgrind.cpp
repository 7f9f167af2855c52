#include "bench/callgrind.h"

#include "bench/disassembly.h"
#include "host/atomic_file.h"
#include "host/child_process.h"
#include "host/errors.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <sstream>
#include <utility>
#include <vector>

namespace clucida::bench {
namespace {

namespace fs = std::filesystem;

using Sum = std::uint64_t CallgrindEvents::*;

/// Where an event of that name is counted; nullptr: nowhere.
Sum event_of(const std::string& name)
{
    static const std::map<std::string, Sum> sums{
        {"Ir", &CallgrindEvents::instructions},
        {"Dr", &CallgrindEvents::data_reads},
        {"Dw", &CallgrindEvents::data_writes},
        {"I1mr", &CallgrindEvents::l1_instruction_misses},
        {"D1mr", &CallgrindEvents::l1_data_misses},
        {"D1mw", &CallgrindEvents::l1_data_misses},
        {"ILmr", &CallgrindEvents::last_instruction_misses},
        {"DLmr", &CallgrindEvents::last_data_misses},
        {"DLmw", &CallgrindEvents::last_data_misses},
        {"Bc", &CallgrindEvents::conditional_branches},
        {"Bcm", &CallgrindEvents::conditional_mispredicted},
        {"Bi", &CallgrindEvents::indirect_branches},
        {"Bim", &CallgrindEvents::indirect_mispredicted},
    };
    const auto found = sums.find(name);
    return found == sums.end() ? nullptr : found->second;
}

/// A profile is read line by line (Valgrind's manual, "Callgrind Format Specification").
class ProfileReader {
public:
    void read(const std::string& line)
    {
        if (line.empty() || line.front() == '#') return;
        if (const char c = line.front(); c == '+' || c == '-' || c == '*' || (c >= '0' && c <= '9')) {
            read_costs(line);
            return;
        }
        if (line.starts_with("events:")) read_events(line.substr(7));
        if (line.starts_with("positions:")) knows_instructions_ = line.find("instr") != std::string::npos;
        if (line.starts_with("calls=")) in_call_ = true;
        if (line.starts_with("ob=")) file_ = name(files_, line.substr(3));
        if (line.starts_with("cob=")) name(files_, line.substr(4));
        if (line.starts_with("fn=")) function_ = name(functions_, line.substr(3));
        if (line.starts_with("cfn=")) name(functions_, line.substr(4));
    }
    ExecutedCode finish()
    {
        if (!knows_instructions_ || events_.empty())
            throw host::Failure("callgrind wrote no profile of single instructions");
        return std::move(out_);
    }

private:
    void read_events(const std::string& text)
    {
        std::istringstream words(text);
        for (std::string word; words >> word;) events_.push_back(event_of(word));
    }

    /// "(3) name" gives the number its name, "(3)" is the name of that number.
    static std::string name(std::map<std::string, std::string>& names, const std::string& text)
    {
        const std::size_t end = text.find(')');
        if (text.front() != '(' || end == std::string::npos) return text;
        const std::string number = text.substr(0, end + 1);
        if (end + 2 < text.size()) names[number] = text.substr(end + 2);
        return names[number];
    }

    /// An address is absolute, or how far it lies from the last one.
    void read_address(const std::string& word)
    {
        if (word == "*") return;
        const bool relative = word.front() == '+' || word.front() == '-';
        const std::uint64_t number = std::stoull(relative ? word.substr(1) : word, nullptr, 0);
        if (!relative)
            address_ = number;
        else if (word.front() == '+')
            address_ += number;
        else
            address_ -= number;
    }

    void read_costs(const std::string& line)
    {
        std::istringstream words(line);
        std::string address, source;
        words >> address >> source;
        read_address(address);
        const bool of_call = std::exchange(in_call_, false); // what a call cost is counted where it was spent
        if (of_call) return;
        CallgrindEvents& function = out_.functions[function_];
        std::uint64_t cost = 0;
        for (std::size_t i = 0; i < events_.size() && words >> cost; ++i) {
            if (!events_[i]) continue;
            out_.total.*events_[i] += cost;
            function.*events_[i] += cost;
            if (events_[i] == &CallgrindEvents::instructions) out_.files[file_][address_] += cost;
        }
    }

    ExecutedCode out_;
    std::vector<Sum> events_;
    std::map<std::string, std::string> files_, functions_;
    std::string file_, function_;
    std::uint64_t address_ = 0;
    bool knows_instructions_ = false, in_call_ = false;
};

int open_file(const fs::path& file, int flags)
{
    const int out = ::open(file.c_str(), flags | O_CLOEXEC, 0600);
    if (out < 0) throw host::Failure("cannot open " + file.string());
    return out;
}

/// Runs the command with its input from a file, all that it says going to another. True if it succeeded.
bool run_with_input(const std::vector<std::string>& command, const fs::path& input, const fs::path& log)
{
    const int in = open_file(input, O_RDONLY), out = open_file(log, O_WRONLY | O_CREAT | O_TRUNC);
    pid_t child = -1;
    try {
        child = host::start_child(command, {}, {in, out, out});
    } catch (const host::Failure&) {
        child = -1;
    }
    ::close(in);
    ::close(out);
    if (child < 0) throw host::Failure("there is no valgrind here: executed instructions cannot be counted");
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace

ExecutedCode parse_callgrind(std::string_view text)
{
    ProfileReader reader;
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);) reader.read(line);
    return reader.finish();
}

InstructionMix executed_mix(const ExecutedCode& code)
{
    InstructionMix out;
    for (const auto& [file, times] : code.files) {
        if (times.empty() || !fs::is_regular_file(file)) continue;
        constexpr std::uint64_t longest = 15; // bytes of an instruction
        for (const CodeFunction& f :
             disassemble(file, AddressRange{times.begin()->first, times.rbegin()->first + longest}))
            for (const CodeLine& line : f.code)
                if (const auto found = times.find(line.address); found != times.end())
                    add(out, classify(line.text), found->second);
    }
    return out;
}

ExecutedCode run_callgrind(const std::string& subcommand, const fs::path& input, const std::string& function,
                           const fs::path& folder)
{
    const fs::path profile = folder / "callgrind.out", log = folder / "callgrind.log";
    const std::vector<std::string> command{"valgrind",
                                           "--tool=callgrind",
                                           "--dump-instr=yes",
                                           "--cache-sim=yes",
                                           "--branch-sim=yes",
                                           "--toggle-collect=" + function,
                                           "--callgrind-out-file=" + profile.string(),
                                           fs::read_symlink("/proc/self/exe").string(),
                                           subcommand};
    constexpr std::size_t most_log = 2000; // characters
    if (!run_with_input(command, input, log))
        throw host::Failure("callgrind failed\n" + host::read_file(log.string()).substr(0, most_log));
    return parse_callgrind(host::read_file(profile.string()));
}

} // namespace clucida::bench
