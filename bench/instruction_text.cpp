#include "bench/instruction_text.h"

#include "bench/words.h"

#include <algorithm>
#include <array>

namespace clucida::bench {
namespace {

constexpr std::array prefixes{"lock", "rep",    "repz",  "repnz", "repe",   "repne", "notrack",  "bnd",     "data16",
                              "cs",   "{evex}", "{vex}", "ds",    "addr32", "rex",   "xacquire", "xrelease"};
constexpr std::string_view spaces = " \t";

std::string_view trimmed(std::string_view text)
{
    const std::size_t begin = text.find_first_not_of(spaces);
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(spaces) - begin + 1);
}

std::string_view take_word(std::string_view& text)
{
    text = trimmed(text);
    const std::size_t end = std::min(text.find_first_of(spaces), text.size());
    const std::string_view word = text.substr(0, end);
    text = trimmed(text.substr(end));
    return word;
}

/// At commas outside of parentheses.
std::vector<std::string_view> split_operands(std::string_view text)
{
    std::vector<std::string_view> out;
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && text[i] == '(') ++depth;
        if (i < text.size() && text[i] == ')') --depth;
        if (i < text.size() && (text[i] != ',' || depth > 0)) continue;
        const std::string_view operand = trimmed(text.substr(begin, i - begin));
        if (!operand.empty()) out.push_back(operand);
        begin = i + 1;
    }
    return out;
}

bool is_memory(std::string_view operand)
{
    return contains(operand, "(") || operand.starts_with("%fs:") || operand.starts_with("%gs:");
}

/// Of a general register: "%rax" 64, "%eax" and "%r8d" 32, "%ax" 16, "%al" 8; 0 if it is none.
unsigned general_bits(std::string_view name)
{
    if (!name.starts_with('%') || name.size() < 3 || starts_with_any(name, {"%xmm", "%ymm", "%zmm", "%k", "%st"}))
        return 0;
    name.remove_prefix(1);
    const bool numbered = name.size() > 1 && name[0] == 'r' && name[1] >= '0' && name[1] <= '9';
    if (name.ends_with('b') && numbered) return 8;
    if (name.ends_with('w') && numbered) return 16;
    if (name.ends_with('d') && numbered) return 32;
    if (name.starts_with('r')) return 64;
    if (name.starts_with('e')) return 32;
    return name.ends_with('l') || name.ends_with('h') ? 8 : 16;
}

unsigned suffix_bits(char letter)
{
    switch (letter) {
    case 'b': return 8;
    case 'w': return 16;
    case 'l': return 32;
    default: return 64;
    }
}

/// stem: the mnemonic without v.
unsigned vector_bits(std::string_view stem, const InstructionText& text, const Instruction& i)
{
    if (std::ranges::any_of(text.operands, [](std::string_view o) { return contains(o, "{1to"); }))
        return i.element == Element::twofold || stem.ends_with('q') ? 64 : 32;
    if (starts_with_any(stem, {"pinsrb", "pextrb", "pbroadcastb"})) return 8;
    if (starts_with_any(stem, {"pinsrw", "pextrw", "pbroadcastw"})) return 16;
    if (starts_with_any(stem, {"broadcastss", "pbroadcastd", "insertps", "extractps", "pinsrd", "pextrd"})) return 32;
    if (starts_with_any(stem, {"movlp", "movhp", "broadcastsd", "pbroadcastq", "pinsrq", "pextrq"})) return 64;
    if (is_any(stem, {"movd", "movq"})) return stem == "movd" ? 32 : 64;
    if (starts_with_any(stem, {"cvtsi2", "cvtusi2"})) return stem.ends_with('l') ? 32 : 64;
    if (starts_with_any(stem, {"insert", "extract", "broadcast"})) {
        if (contains(stem, "x8") || contains(stem, "64x4")) return 256;
        return contains(stem, "32x2") ? 64 : 128;
    }
    if (i.element != Element::none && !i.packed) return i.element == Element::single ? 32 : 64;
    return i.width;
}

unsigned plain_bits(const InstructionText& text)
{
    const std::string_view m = text.mnemonic;
    if (m.starts_with("kmov")) return suffix_bits(m.back() == 'd' ? 'l' : m.back());
    if (starts_with_any(m, {"call", "jmp"})) return 64;
    if (m.starts_with("set")) return 8;
    if (starts_with_any(m, {"movzb", "movsb"})) return 8;
    if (starts_with_any(m, {"movzw", "movsw"})) return 16;
    if (starts_with_any(m, {"movslq"})) return 32;
    for (const std::string_view operand : text.operands)
        if (const unsigned bits = is_memory(operand) ? 0 : general_bits(operand)) return bits;
    return suffix_bits(m.back());
}

/// Whether the destination is written without being read, as moves do it.
bool only_writes(std::string_view m, const Instruction& i)
{
    if (i.width || m.starts_with("kmov")) return true;
    return starts_with_any(m, {"mov", "set", "pop", "stos"});
}

bool only_reads(std::string_view m, const Instruction& i)
{
    if (i.width) return false;
    if (i.operation == Operation::branch || i.operation == Operation::call) return true;
    return starts_with_any(m, {"cmp", "test", "push", "div", "idiv", "mul", "imul", "bt", "fld", "ldmxcsr"}) &&
           !starts_with_any(m, {"cmpxchg", "btr", "bts", "btc"});
}

} // namespace

bool InstructionText::names(std::string_view beginning) const
{
    return std::ranges::any_of(operands, [&](std::string_view o) { return o.starts_with(beginning); });
}

unsigned InstructionText::register_bits() const
{
    unsigned bits = 0;
    for (const std::string_view operand : operands) {
        if (contains(operand, "%zmm")) bits = std::max(bits, 512U);
        if (contains(operand, "%ymm")) bits = std::max(bits, 256U);
        if (contains(operand, "%xmm")) bits = std::max(bits, 128U);
    }
    return bits;
}

InstructionText parse_instruction(std::string_view line)
{
    line = line.substr(0, line.find_first_of("#<"));
    InstructionText out;
    std::string_view word = take_word(line);
    while (std::ranges::any_of(prefixes, [&](std::string_view p) { return word == p; }) && !line.empty()) {
        out.repeated |= word.starts_with("rep");
        word = take_word(line);
    }
    out.mnemonic = word;
    out.operands = split_operands(line);
    return out;
}

MemoryAccess memory_access(const InstructionText& text, const Instruction& i)
{
    const std::string_view m = text.mnemonic;
    MemoryAccess out;
    if (text.operands.empty() || starts_with_any(m, {"lea", "nop", "prefetch"})) return out;
    const std::string_view stem = m.starts_with('v') ? m.substr(1) : m;
    const unsigned bits = i.width ? vector_bits(stem, text, i) : plain_bits(text);
    const bool into_memory = is_memory(text.operands.back());
    for (std::size_t k = 0; k + 1 < text.operands.size(); ++k)
        if (is_memory(text.operands[k])) out.load_bits = bits;
    if (!into_memory) return out;
    if (only_reads(m, i))
        out.load_bits = bits;
    else
        out.store_bits = bits;
    if (out.store_bits && !only_writes(m, i)) out.load_bits = bits;
    return out;
}

} // namespace clucida::bench
