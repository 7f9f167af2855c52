/// The machine code of a library, as a disassembler prints it.
#pragma once

#include "bench/instruction_mix.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::bench {

struct CodeLine {
    std::uint64_t address = 0;
    std::string text; ///< one instruction in AT&T syntax
};

struct CodeFunction {
    std::string name; ///< of the symbol that it begins with
    std::vector<CodeLine> code;
};

/// What objdump or llvm-objdump printed. Bytes that make no instruction are left out.
std::vector<CodeFunction> parse_disassembly(std::string_view text);

/// Addresses as the file has them; last is not among them.
struct AddressRange {
    std::uint64_t first = 0, last = 0;
};

/// Disassembles a file, or a part of it, by objdump or else llvm-objdump.
/// @throws host::Failure if neither is there, or both fail
std::vector<CodeFunction> disassemble(const std::filesystem::path& file, std::optional<AddressRange> part = {});

/// Each of its instructions once.
InstructionMix mix_of(const CodeFunction& function);

std::vector<std::filesystem::path> machine_code_in(const std::filesystem::path& folder);

} // namespace clucida::bench
