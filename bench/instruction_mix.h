/// What machine code is made of: x86-64 instructions, by what they do and how wide.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

namespace clucida::bench {

enum class Operation {
    arithmetic, ///< add, subtract, multiply of floating-point numbers
    fma,
    divide, ///< and approximate reciprocals
    square_root,
    min_max,
    compare_blend, ///< of floating-point numbers, and what picks lanes by the outcome
    logic,         ///< bits of floating-point registers
    convert,       ///< and round
    shuffle,       ///< between lanes, broadcasts included
    move,          ///< of vector registers, to and from memory too
    gather,        ///< and scatter
    vector_integer,
    mask,    ///< mask registers, and masks brought to integer registers
    integer, ///< everything else of general registers, moves included
    branch,
    call, ///< and return
    other
};

/// Of floating-point instructions.
enum class Element { none, single, twofold };

struct Instruction {
    Operation operation = Operation::other;
    Element element = Element::none;
    bool packed = false;    ///< works on all lanes, not on the lowest alone
    unsigned width = 0;     ///< of the widest vector register named, bits; 0: none
    unsigned load_bits = 0; ///< that it reads by an operand in memory; pushes, pops and calls have none
    unsigned store_bits = 0;
};

/// One instruction in AT&T syntax as objdump and llvm-objdump print it: "vaddps (%rax),%ymm1,%ymm2". What is not known
/// counts as integer.
Instruction classify(std::string_view text);

/// Floating-point operations of one instruction: a lane's sum, difference, product, quotient or root is one, its fma
/// two. Approximations, comparisons, minima and lanes switched off by a mask are not looked at: the latter count.
unsigned flops(const Instruction& instruction);

/// The instructions of which a mix keeps one count.
struct InstructionKind {
    Operation operation = Operation::other;
    Element element = Element::none;
    bool packed = false;
    unsigned width = 0;
    bool operator<(const InstructionKind& other) const
    {
        return std::tie(operation, element, packed, width) <
               std::tie(other.operation, other.element, other.packed, other.width);
    }
};

/// "fma packed float 256", "integer"
std::string describe(const InstructionKind& kind);
std::string operation_name(Operation operation);

struct InstructionMix {
    std::map<InstructionKind, std::uint64_t> kinds;
    std::map<unsigned, std::uint64_t> loads, stores; ///< by bits
    std::uint64_t instructions = 0;
    std::uint64_t single_flops = 0, double_flops = 0;
    std::uint64_t load_bytes = 0, store_bytes = 0;
};

/// Counts the instruction so many times.
void add(InstructionMix& mix, const Instruction& instruction, std::uint64_t times = 1);
void add(InstructionMix& mix, const InstructionMix& other);

/// How many of them there are, of any width.
std::uint64_t count(const InstructionMix& mix, Operation operation);

} // namespace clucida::bench
