/// What Valgrind's callgrind counted: how often each instruction was executed, and what its simulated caches and branch
/// predictor made of it.
#pragma once

#include "bench/instruction_mix.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace clucida::bench {

/// As callgrind names its events; 0 what was not counted.
struct CallgrindEvents {
    std::uint64_t instructions = 0;                                       ///< Ir
    std::uint64_t data_reads = 0, data_writes = 0;                        ///< Dr, Dw
    std::uint64_t l1_instruction_misses = 0, l1_data_misses = 0;          ///< I1mr, D1mr + D1mw
    std::uint64_t last_instruction_misses = 0, last_data_misses = 0;      ///< ILmr, DLmr + DLmw: to memory
    std::uint64_t conditional_branches = 0, conditional_mispredicted = 0; ///< Bc, Bcm
    std::uint64_t indirect_branches = 0, indirect_mispredicted = 0;       ///< Bi, Bim
};

struct ExecutedCode {
    CallgrindEvents total;
    std::map<std::string, CallgrindEvents> functions; ///< by name: of a function itself, without what it calls
    /// Of each file of machine code: how often the instruction at an address was executed.
    std::map<std::string, std::map<std::uint64_t, std::uint64_t>> files;
};

/// Reads a profile that was written with --dump-instr=yes. @throws host::Failure if it is none
ExecutedCode parse_callgrind(std::string_view text);

/// What was executed, by disassembling the files that it lies in. Instructions of which no text is to be had are left
/// out. @throws host::Failure if there is no disassembler
InstructionMix executed_mix(const ExecutedCode& code);

/// Runs this very program with the subcommand under callgrind, its standard input from a file. Counts only while the
/// function runs, with the caches and branch predictor of callgrind's own.
/// @throws host::Failure if there is no Valgrind, or if it fails
ExecutedCode run_callgrind(const std::string& subcommand, const std::filesystem::path& input,
                           const std::string& function, const std::filesystem::path& folder);

} // namespace clucida::bench
