#include "bench/disassembly.h"

#include "bench/temporary_folder.h"
#include "bench/words.h"
#include "host/atomic_file.h"
#include "host/child_process.h"
#include "host/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>

namespace clucida::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view blanks = " \t";

/// The hexadecimal number that a line begins with, which it takes off; nothing if there is none.
std::optional<std::uint64_t> take_address(std::string_view& line)
{
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    std::uint64_t out = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), out, 16);
    if (error != std::errc()) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return out;
}

void read_line(std::string_view line, std::vector<CodeFunction>& out)
{
    const auto address = take_address(line);
    if (!address) return;
    if (line.starts_with(" <") && line.ends_with(">:")) {
        out.push_back({std::string(line.substr(2, line.size() - 4)), {}});
        return;
    }
    if (!line.starts_with(':')) return;
    line.remove_prefix(std::min(line.find_first_not_of(blanks, 1), line.size()));
    if (line.empty() || starts_with_any(line, {"(bad)", "<unknown>", "..."})) return;
    if (out.empty()) out.emplace_back();
    out.back().code.push_back({*address, std::string(line)});
}

std::vector<std::string> command_of(const std::string& program, const fs::path& file, std::optional<AddressRange> part)
{
    std::vector<std::string> out{program, "-d", "--no-show-raw-insn"};
    if (part) {
        out.push_back(fmt::format("--start-address={:#x}", part->first));
        out.push_back(fmt::format("--stop-address={:#x}", part->last));
    }
    out.push_back(file.string());
    return out;
}

/// Nothing if there is no such program, or if it fails.
std::optional<std::string> printed_by(const std::vector<std::string>& command)
{
    const TemporaryFolder folder;
    const std::string output = (folder.path() / "printed").string();
    try {
        if (!host::run_child(command, output)) return std::nullopt;
    } catch (const host::Failure&) {
        return std::nullopt; // it cannot be started
    }
    return host::read_file(output);
}

/// The file's header (System V ABI, chapter 4): its magic, and the machine it is for.
bool is_machine_code(const fs::path& file)
{
    constexpr std::size_t machine_at = 18;
    constexpr char x86_64 = 62;
    std::array<char, machine_at + 2> head{};
    std::ifstream in(file, std::ios::binary);
    if (!in.read(head.data(), head.size())) return false;
    return std::string_view(head.data(), 4) == "\x7f"
                                               "ELF" &&
           head[machine_at] == x86_64 && head[machine_at + 1] == 0;
}

} // namespace

std::vector<CodeFunction> parse_disassembly(std::string_view text)
{
    std::vector<CodeFunction> out;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        read_line(text.substr(begin, end - begin), out);
        begin = end + 1;
    }
    return out;
}

std::vector<CodeFunction> disassemble(const fs::path& file, std::optional<AddressRange> part)
{
    for (const char* program : {"objdump", "llvm-objdump"})
        if (const auto text = printed_by(command_of(program, file, part))) return parse_disassembly(*text);
    throw host::Failure(
        fmt::format("{} cannot be disassembled: install objdump (binutils) or llvm-objdump", file.string()));
}

InstructionMix mix_of(const CodeFunction& function)
{
    InstructionMix out;
    for (const CodeLine& line : function.code) add(out, classify(line.text));
    return out;
}

std::vector<fs::path> machine_code_in(const fs::path& folder)
{
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && is_machine_code(entry.path())) out.push_back(entry.path());
    std::ranges::sort(out);
    return out;
}

} // namespace clucida::bench
