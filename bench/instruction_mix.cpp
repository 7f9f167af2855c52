#include "bench/instruction_mix.h"

#include "bench/instruction_text.h"
#include "bench/words.h"

#include <fmt/format.h>

#include <array>

namespace clucida::bench {
namespace {

/// What a floating-point vector instruction does, by its stem: the mnemonic without v, type and width.
Operation vector_operation(std::string_view stem)
{
    if (starts_with_any(stem, {"fmadd", "fmsub", "fnmadd", "fnmsub", "fmaddsub", "fmsubadd"})) return Operation::fma;
    if (starts_with_any(stem, {"div", "rcp"})) return Operation::divide;
    if (starts_with_any(stem, {"sqrt", "rsqrt"})) return Operation::square_root;
    if (is_any(stem, {"min", "max"})) return Operation::min_max;
    if (starts_with_any(stem, {"cmp", "ucomi", "comi", "blend", "test", "fpclass"})) return Operation::compare_blend;
    if (starts_with_any(stem,
                        {"cvt", "round", "rndscale", "reduce", "range", "getexp", "getmant", "scalef", "fixupimm"}))
        return Operation::convert;
    if (is_any(stem, {"and", "andn", "or", "xor"})) return Operation::logic;
    if (starts_with_any(stem, {"gather", "scatter"})) return Operation::gather;
    if (starts_with_any(stem, {"movmsk"})) return Operation::mask;
    if (starts_with_any(stem, {"movddup", "movshdup", "movsldup", "movhl", "movlh", "shuf", "unpck", "perm", "insert",
                               "extract", "broadcast", "expand", "compress"}))
        return Operation::shuffle;
    if (starts_with_any(stem, {"mov", "lddqu"})) return Operation::move;
    return Operation::arithmetic; // add, sub, mul, addsub, hadd, dp
}

/// Sets element and packed by the mnemonic's last two letters, which it takes off. False if there is no such type.
bool take_type(std::string_view& stem, Instruction& out)
{
    struct Type {
        std::string_view ending;
        Element element;
        bool packed;
    };
    constexpr std::array types{Type{"ps", Element::single, true}, Type{"pd", Element::twofold, true},
                               Type{"ss", Element::single, false}, Type{"sd", Element::twofold, false}};
    for (const Type& type : types) {
        if (!stem.ends_with(type.ending)) continue;
        stem.remove_suffix(type.ending.size());
        out.element = type.element;
        out.packed = type.packed;
        return true;
    }
    return false;
}

/// Conversions and tests of numbers name their type last or first, and an integer's size after that.
void classify_conversion(std::string_view stem, Instruction& out)
{
    out.operation = Operation::convert;
    const bool twofold = stem.ends_with("pd") || stem.ends_with("sd") || contains(stem, "pd2") || contains(stem, "sd2");
    out.element = twofold ? Element::twofold : Element::single;
    out.packed = contains(stem, "ps") || contains(stem, "pd");
}

void classify_vector(std::string_view stem, Instruction& out)
{
    if (stem.starts_with("cvt")) {
        classify_conversion(stem, out);
    } else if (starts_with_any(stem, {"pgather", "pscatter"})) {
        out.operation = Operation::gather;
    } else if (starts_with_any(stem, {"pmovmsk", "ptest"}) || stem.starts_with("test")) {
        out.operation = Operation::mask;
    } else if (starts_with_any(stem, {"movd", "movq", "movnt", "lddqu"}) && !stem.starts_with("movddup")) {
        out.operation = Operation::move;
    } else if (starts_with_any(stem, {"insertf", "inserti", "extractf", "extracti", "broadcastf", "broadcasti", "shuff",
                                      "shufi"})) {
        out.operation = Operation::shuffle;
    } else if (stem.starts_with('p') && !starts_with_any(stem, {"perm"})) {
        out.operation = Operation::vector_integer;
    } else if (take_type(stem, out)) {
        out.operation = vector_operation(stem);
        if (out.operation == Operation::shuffle) out.packed = true; // "vbroadcastss" fills all lanes
        if (out.operation == Operation::mask) out.element = Element::none;
    } else {
        out.operation = stem.starts_with("perm") ? Operation::shuffle : Operation::vector_integer;
    }
}

/// What comes without vector registers.
Operation plain_operation(std::string_view mnemonic)
{
    if (mnemonic.starts_with('j') || mnemonic.starts_with("loop")) return Operation::branch;
    if (starts_with_any(mnemonic, {"call", "ret"})) return Operation::call;
    if (starts_with_any(mnemonic, {"nop", "endbr", "int3", "ud2", "vzero", "prefetch", "pause", "fence", "xchg %ax"}))
        return Operation::other;
    if (mnemonic.starts_with('f')) return Operation::other; // x87
    return Operation::integer;
}

bool is_mask_operation(const InstructionText& text)
{
    return text.mnemonic.starts_with('k') && (text.names("%k") || starts_with_any(text.mnemonic, {"kmov"}));
}

} // namespace

Instruction classify(std::string_view line)
{
    const InstructionText text = parse_instruction(line);
    Instruction out;
    out.width = text.register_bits();
    std::string_view stem = text.mnemonic;
    if (is_mask_operation(text)) {
        out.operation = Operation::mask;
    } else if (out.width) {
        if (stem.starts_with('v')) stem.remove_prefix(1);
        classify_vector(stem, out);
    } else {
        out.operation = plain_operation(stem);
    }
    const MemoryAccess access = memory_access(text, out);
    out.load_bits = access.load_bits;
    out.store_bits = access.store_bits;
    return out;
}

unsigned flops(const Instruction& i)
{
    const bool counts = i.operation == Operation::arithmetic || i.operation == Operation::fma ||
                        i.operation == Operation::divide || i.operation == Operation::square_root;
    if (!counts || i.element == Element::none) return 0;
    const unsigned lanes = i.packed ? i.width / (i.element == Element::single ? 32 : 64) : 1;
    return lanes * (i.operation == Operation::fma ? 2 : 1);
}

std::string operation_name(Operation operation)
{
    switch (operation) {
    case Operation::arithmetic: return "add, subtract, multiply";
    case Operation::fma: return "fma";
    case Operation::divide: return "divide";
    case Operation::square_root: return "square root";
    case Operation::min_max: return "minimum, maximum";
    case Operation::compare_blend: return "compare, blend";
    case Operation::logic: return "bits of floats";
    case Operation::convert: return "convert, round";
    case Operation::shuffle: return "shuffle, broadcast";
    case Operation::move: return "vector move";
    case Operation::gather: return "gather, scatter";
    case Operation::vector_integer: return "vector integer";
    case Operation::mask: return "mask";
    case Operation::integer: return "integer";
    case Operation::branch: return "branch";
    case Operation::call: return "call, return";
    case Operation::other: break;
    }
    return "other";
}

std::string describe(const InstructionKind& kind)
{
    std::string out = operation_name(kind.operation);
    if (kind.element != Element::none) {
        out += kind.packed ? " packed" : " scalar";
        out += kind.element == Element::single ? " float" : " double";
    }
    if (kind.width && (kind.packed || kind.element == Element::none)) out += fmt::format(" {}", kind.width);
    return out;
}

void add(InstructionMix& mix, const Instruction& i, std::uint64_t times)
{
    const bool of_lanes = i.packed || i.element == Element::none;
    mix.kinds[{i.operation, i.element, i.element != Element::none && i.packed, of_lanes ? i.width : 0}] += times;
    mix.instructions += times;
    (i.element == Element::single ? mix.single_flops : mix.double_flops) += times * flops(i);
    if (i.load_bits) mix.loads[i.load_bits] += times;
    if (i.store_bits) mix.stores[i.store_bits] += times;
    mix.load_bytes += times * i.load_bits / 8;
    mix.store_bytes += times * i.store_bits / 8;
}

void add(InstructionMix& mix, const InstructionMix& other)
{
    for (const auto& [kind, times] : other.kinds) mix.kinds[kind] += times;
    for (const auto& [bits, times] : other.loads) mix.loads[bits] += times;
    for (const auto& [bits, times] : other.stores) mix.stores[bits] += times;
    mix.instructions += other.instructions;
    mix.single_flops += other.single_flops;
    mix.double_flops += other.double_flops;
    mix.load_bytes += other.load_bytes;
    mix.store_bytes += other.store_bytes;
}

std::uint64_t count(const InstructionMix& mix, Operation operation)
{
    std::uint64_t out = 0;
    for (const auto& [kind, times] : mix.kinds)
        if (kind.operation == operation) out += times;
    return out;
}

} // namespace clucida::bench
