#include "bench/profile_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace clucida::bench {
namespace {

/// A column of instructions: a share of their number, or how many a ray executes.
struct Column {
    const InstructionMix& mix;
    double of; ///< what counts are divided by
    bool share = false;
};

std::string cell(std::uint64_t count, const Column& c)
{
    if (count == 0) return "";
    const double value = static_cast<double>(count) / c.of;
    return c.share ? fmt::format("{:.2f} %", 100 * value) : fmt::format("{:.2f}", value);
}

void print_kinds(std::FILE* to, const std::vector<Column>& columns)
{
    std::set<InstructionKind> kinds;
    for (const Column& c : columns)
        for (const auto& [kind, times] : c.mix.kinds) kinds.insert(kind);
    for (const InstructionKind& kind : kinds) {
        fmt::print(to, "| {} |", describe(kind));
        for (const Column& c : columns) {
            const auto found = c.mix.kinds.find(kind);
            fmt::print(to, " {} |", cell(found == c.mix.kinds.end() ? 0 : found->second, c));
        }
        fmt::print(to, "\n");
    }
}

void print_accesses(std::FILE* to, const std::vector<Column>& columns, const char* name,
                    const std::map<unsigned, std::uint64_t> InstructionMix::*accesses)
{
    std::set<unsigned> widths;
    for (const Column& c : columns)
        for (const auto& [bits, times] : c.mix.*accesses) widths.insert(bits);
    for (const unsigned bits : widths) {
        fmt::print(to, "| *{} {} bits* |", name, bits);
        for (const Column& c : columns) {
            const auto found = (c.mix.*accesses).find(bits);
            fmt::print(to, " {} |", cell(found == (c.mix.*accesses).end() ? 0 : found->second, c));
        }
        fmt::print(to, "\n");
    }
}

std::uint64_t packed(const InstructionMix& mix, unsigned width)
{
    std::uint64_t out = 0;
    for (const auto& [kind, times] : mix.kinds)
        if (kind.packed && kind.width == width) out += times;
    return out;
}

std::uint64_t scalar(const InstructionMix& mix)
{
    std::uint64_t out = 0;
    for (const auto& [kind, times] : mix.kinds)
        if (!kind.packed && kind.element != Element::none) out += times;
    return out;
}

void print_functions(std::FILE* to, const StaticCode& code)
{
    constexpr std::size_t most = 12;
    fmt::print(to,
               "\n{}: its {} largest functions.\n\n"
               "| function | instructions | packed 512 | 256 | 128 | scalar | divide | root | branches | calls |\n"
               "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
               code.what, std::min(most, code.functions.size()));
    for (std::size_t i = 0; i < std::min(most, code.functions.size()); ++i) {
        const InstructionMix& m = code.functions[i].mix;
        fmt::print(to, "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", code.functions[i].name, m.instructions,
                   packed(m, 512), packed(m, 256), packed(m, 128), scalar(m), count(m, Operation::divide),
                   count(m, Operation::square_root), count(m, Operation::branch), count(m, Operation::call));
    }
}

void print_executed_functions(std::FILE* to, const ExecutedPicture& e)
{
    constexpr std::size_t most = 12;
    std::vector<std::pair<std::string, CallgrindEvents>> functions(e.code.functions.begin(), e.code.functions.end());
    std::ranges::sort(functions,
                      [](const auto& a, const auto& b) { return a.second.instructions > b.second.instructions; });
    if (functions.size() > most) functions.resize(most);
    fmt::print(to, "\nExecuted, by function, without what they call:\n\n"
                   "| function | of all instructions | branches mispredicted a ray | L1 misses a ray |\n"
                   "|---|---:|---:|---:|\n");
    const auto rays = static_cast<double>(all_rays(e.counted));
    for (const auto& [name, events] : functions)
        fmt::print(to, "| {} | {:.1f} % | {:.3f} | {:.3f} |\n", name,
                   100 * static_cast<double>(events.instructions) / static_cast<double>(e.code.total.instructions),
                   static_cast<double>(events.conditional_mispredicted + events.indirect_mispredicted) / rays,
                   static_cast<double>(events.l1_data_misses + events.l1_instruction_misses) / rays);
}

} // namespace

void print_code(std::FILE* to, const SceneProfile& p)
{
    fmt::print(to, "\n### Instructions\n\n| x86-64 instructions |");
    std::vector<Column> columns;
    for (const StaticCode& code : p.code) {
        columns.push_back({code.all, static_cast<double>(std::max<std::uint64_t>(code.all.instructions, 1)), true});
        fmt::print(to, " in the code of {} |",
                   &code == &p.code.front() && p.code.size() > 1 ? "the device" : "the native build");
    }
    if (p.executed) {
        columns.push_back(
            {p.executed->mix, static_cast<double>(std::max<std::uint64_t>(all_rays(p.executed->counted), 1))});
        fmt::print(to, " executed a ray |");
    }
    fmt::print(to, "\n|---|");
    for (std::size_t i = 0; i < columns.size(); ++i) fmt::print(to, "---:|");
    fmt::print(to, "\n");
    print_kinds(to, columns);
    print_accesses(to, columns, "loads of", &InstructionMix::loads);
    print_accesses(to, columns, "stores of", &InstructionMix::stores);
    fmt::print(to,
               "\nIn the code: as it lies in the file, each instruction once, however often it runs; in per cent of "
               "them. Loads and stores are operands of the instructions above them.\n");
    for (const StaticCode& code : p.code) print_functions(to, code);
    if (!p.executed) return;
    fmt::print(
        to, "\nExecuted: {}, {}x{}, one thread, under Valgrind; {} of {} instructions could be told by their text.\n",
        p.executed->what, p.executed->picture.width, p.executed->picture.height, p.executed->mix.instructions,
        p.executed->code.total.instructions);
    print_executed_functions(to, *p.executed);
}

void print_limits(std::FILE* to, const SceneProfile& p)
{
    const ExecutedPicture& e = *p.executed;
    const CallgrindEvents& events = e.code.total;
    const auto rays = static_cast<double>(all_rays(e.counted));
    const double seconds = e.cpu / rays, cycles = seconds * p.peaks.clock;
    const auto a_ray = [&](std::uint64_t n) { return static_cast<double>(n) / rays; };
    const double flop = a_ray(e.mix.single_flops + e.mix.double_flops);
    const double mispredicted = a_ray(events.conditional_mispredicted + events.indirect_mispredicted);
    fmt::print(to, "\n### What limits it\n\n| a ray | |\n|---|---:|\n");
    const auto row = [&](const char* name, const std::string& value) { fmt::print(to, "| {} | {} |\n", name, value); };
    row("time, ns", fmt::format("{:.1f}", 1e9 * seconds));
    row("instructions", fmt::format("{:.0f}", a_ray(events.instructions)));
    if (p.peaks.clock > 0) {
        row("cycles", fmt::format("{:.0f}", cycles));
        row("instructions a cycle", fmt::format("{:.2f}", a_ray(events.instructions) / cycles));
    }
    row("floating-point operations", fmt::format("{:.0f}", flop));
    row("... GFLOP/s", fmt::format("{:.2f}", 1e-9 * flop / seconds));
    row("... of the device's peak on one processor",
        fmt::format("{:.1f} % of {:.0f} GFLOP/s", 100 * flop / seconds / p.peaks.flops, 1e-9 * p.peaks.flops));
    row("divisions and roots, instructions",
        fmt::format("{:.1f}", a_ray(count(e.mix, Operation::divide) + count(e.mix, Operation::square_root))));
    row("branches", fmt::format("{:.1f}", a_ray(events.conditional_branches + events.indirect_branches)));
    row("... mispredicted", fmt::format("{:.2f}", mispredicted));
    row("bytes loaded and stored", fmt::format("{:.0f}, {:.0f}", a_ray(e.mix.load_bytes), a_ray(e.mix.store_bytes)));
    row("first cache missed: data, instructions",
        fmt::format("{:.3f}, {:.3f}", a_ray(events.l1_data_misses), a_ray(events.l1_instruction_misses)));
    row("all caches missed", fmt::format("{:.4f}", a_ray(events.last_data_misses + events.last_instruction_misses)));
    fmt::print(
        to, "\nCounts are Valgrind's, with its own branch predictor and caches of this processor's sizes; time is that "
            "of the same code without it, one thread. Peak is what fma in a loop attains on the device.\n");
}

} // namespace clucida::bench
