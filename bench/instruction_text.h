/// A disassembled instruction taken apart: AT&T syntax, in which the last operand is the destination.
#pragma once

#include "bench/instruction_mix.h"

#include <string_view>
#include <vector>

namespace clucida::bench {

struct InstructionText {
    std::string_view mnemonic;              ///< without prefixes (lock, rep, notrack ...)
    std::vector<std::string_view> operands; ///< "%ymm1", "0x8(%rax,%rcx,4)", "$0x1"
    bool repeated = false;                  ///< had a prefix rep

    /// Whether an operand is a register whose name begins so: "%k".
    bool names(std::string_view beginning) const;
    /// Of the widest vector register that an operand names, 0 if there is none.
    unsigned register_bits() const;
};

/// Views into the line, of which what follows '#' or '<' is a remark.
InstructionText parse_instruction(std::string_view line);

struct MemoryAccess {
    unsigned load_bits = 0, store_bits = 0;
};

/// What its operand in memory, if it has one, is read or written by. A width that the text leaves open is that of its
/// registers, or 64 bits.
MemoryAccess memory_access(const InstructionText& text, const Instruction& instruction);

} // namespace clucida::bench
