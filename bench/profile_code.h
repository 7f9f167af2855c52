/// The machine code of a scene's kernel: what it is made of, and what of it is executed.
#pragma once

#include "bench/callgrind.h"
#include "bench/instruction_mix.h"
#include "bench/speed_task.h"

#include <filesystem>
#include <string>
#include <vector>

namespace clucida::bench {

struct FunctionMix {
    std::string name;
    InstructionMix mix;
};

/// Code as it lies in a file, each instruction counted once, however often it runs.
struct StaticCode {
    std::string what; ///< whose it is
    std::vector<FunctionMix> functions;
    InstructionMix all;
};

/// What the folder keeps of compiled kernels. No functions if there is no machine code of x86-64 in it.
/// @throws host::Failure if there is no disassembler
StaticCode static_code(const std::string& what, const std::filesystem::path& folder);

/// What the kernels' core executes for a picture, compiled for Haswell: Valgrind knows no wider vectors.
struct ExecutedPicture {
    std::string what; ///< the compiler
    host::Shape picture;
    host::Statistics counted;
    ExecutedCode code;
    InstructionMix mix;
    double cpu = 0; ///< s that the same picture takes without Valgrind: the least of some
};

/// task: of the picture; its contender becomes native. The folder keeps what is compiled.
/// @throws host::Failure if there is no compiler, Valgrind or disassembler
ExecutedPicture count_executed(SpeedTask task, const std::filesystem::path& folder);

} // namespace clucida::bench
