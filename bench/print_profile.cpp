#include "bench/error_output.h"
#include "bench/median.h"
#include "bench/precision_name.h"
#include "bench/profile_output.h"
#include "bench/spread.h"

#include <fmt/format.h>

namespace clucida::bench {
namespace {

double ratio(std::uint64_t of, std::uint64_t to)
{
    return to ? static_cast<double>(of) / static_cast<double>(to) : 0;
}

void print_hops(std::FILE* to, const PathLengths& paths)
{
    fmt::print(to,
               "\nRays by the surfaces before them, of {} pixels on a grid, one ray at a time:\n\n"
               "| hops | rays | met a surface | both ways on | ended there | pixels that ended by then |\n"
               "|---:|---:|---:|---:|---:|---:|\n",
               paths.pixels);
    std::uint64_t ended = 0;
    for (std::size_t hop = 0; hop < paths.hops.size(); ++hop) {
        const HopCount& h = paths.hops[hop];
        ended += h.deepest;
        fmt::print(to, "| {} | {} | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % |\n", hop, h.rays,
                   100 * ratio(h.hits, h.rays), 100 * ratio(h.branched, h.rays), 100 * ratio(h.ended, h.rays),
                   100 * ratio(ended, paths.pixels));
    }
    fmt::print(to, "\nOf these {} rays {:.1f} % met a surface.\n", paths.rays, 100 * ratio(paths.hits, paths.rays));
    if (paths.unseen) fmt::print(to, "{} more were not looked at.\n", paths.unseen);
}

/// What was asked of a row: what it costs, or how it compares.
std::string cost_cells(const AblationTime& t)
{
    if (t.how == How::whole) return "- | - | - |";
    if (t.how == How::instead) return "- | - | - |";
    const std::string each = t.each != 0 ? fmt::format("{:.1f}", t.each) : "-";
    return fmt::format("{:.2f} ± {:.2f} | {:.1f} % | {} |", 1e3 * t.cost, 1e3 * t.cost_spread, 100 * t.share, each);
}

const AblationTime* find_time(const SceneProfile& p, Stage stage)
{
    for (const ProfileTime& row : p.times)
        if (row.time.stage == stage) return &row.time;
    return nullptr;
}

/// What the stages cost together, and what is left for shading and the stacks of rays.
void print_stages(std::FILE* to, const SceneProfile& p, const host::DeviceInfo& device)
{
    const double whole = median(counting_times(p.times.front().time, device));
    double rest = whole;
    fmt::print(to, "\n| stage | ms | of all |\n|---|---:|---:|\n");
    const auto row = [&](const char* name, double seconds) {
        fmt::print(to, "| {} | {:.2f} | {:.1f} % |\n", name, 1e3 * seconds, 100 * seconds / whole);
    };
    if (const AblationTime* t = find_time(p, Stage::observer)) {
        const double seconds = median(counting_times(*t, device));
        row("the observer's rays, launch and way back", seconds);
        rest -= seconds;
    }
    const std::pair<Stage, const char*> costs[] = {{Stage::search, "quick searches"},
                                                   {Stage::confirm, "confirming surfaces"},
                                                   {Stage::full, "full searches"},
                                                   {Stage::shadow, "searches of shadow rays"}};
    for (const auto& [stage, name] : costs) {
        const AblationTime* t = find_time(p, stage);
        if (!t) continue;
        row(name, t->cost);
        rest -= t->cost;
    }
    row("the rest: shading, stacks of rays", rest);
    fmt::print(to,
               "\nWhat is done twice finds its data in the caches and its branches foreseen: its cost is rather too "
               "low, and the rest too high.\n");
}

} // namespace

std::uint64_t all_rays(const host::Statistics& counted)
{
    return counted.rays + counted.shadow;
}

const char* how_name(How how)
{
    switch (how) {
    case How::left_out: return "left out";
    case How::twice: return "twice";
    case How::instead: return "instead";
    case How::whole: break;
    }
    return "-";
}

void print_counts(std::FILE* to, const SceneProfile& p, const ProfileSettings& settings)
{
    const host::Statistics& s = p.counted;
    const std::uint64_t pixels = host::area(settings.picture);
    struct Row {
        const char* name;
        std::uint64_t count;
    };
    const Row rows[] = {{"rays, shadow rays apart", s.rays},
                        {"... the observer's", s.primary},
                        {"... reflected", s.reflected},
                        {"... refracted", s.refracted},
                        {"shadow rays", s.shadow},
                        {"searches", s.queries},
                        {"... and the full search after", s.full},
                        {"objects tested past their bound", s.tests},
                        {"nodes opened on walks through the tree", p.nodes},
                        {"silent crossings", s.silent},
                        {"rays ended by the cutoff", s.cut_branches},
                        {"rays ended by the hop limit", s.hop_branches}};
    fmt::print(to, "\n### Counts\n\n| of {} objects | in all | a pixel | a ray |\n|---|---:|---:|---:|\n", p.objects);
    for (const Row& row : rows)
        fmt::print(to, "| {} | {} | {:.3f} | {:.4f} |\n", row.name, row.count, ratio(row.count, pixels),
                   ratio(row.count, all_rays(s)));
    const std::string faults = host::describe_faults(s);
    fmt::print(to, "\nFaults: {}.\n", faults.empty() ? "none" : faults);
    print_hops(to, p.paths);
}

void print_times(std::FILE* to, const SceneProfile& p, const ProfileSettings& settings, const host::DeviceInfo& device)
{
    const bool cpu = counts_by_processor(device);
    fmt::print(to,
               "\n### Time\n\n"
               "| work | how | ms | IQR | cost, ms | of all | ns each | ratio | rays | change, RMSE | error, RMSE |\n"
               "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const ProfileTime& row : p.times) {
        const AblationTime& t = row.time;
        if (t.meaningless) continue;
        const std::vector<double>& times = counting_times(t, device);
        fmt::print(to, "| {} | {} | {:.2f} | {:.2f} | {} {:.2f} | {:.2f} | {:.1e} | {} |\n", t.name, how_name(t.how),
                   1e3 * median(times), 1e3 * interquartile_range(times), cost_cells(t), t.ratio,
                   ratio(t.counted.rays, p.counted.rays), t.change.rmse,
                   row.error ? fmt::format("{:.1e}", row.error->rmse) : "-");
    }
    fmt::print(
        to,
        "\nMilliseconds of {}, medians of {} rounds in turns. A cost is the median of the rounds' differences to "
        "the whole, ± their interquartile range; ratio is to the whole's time, and so are rays, without shadow "
        "rays. Change is from the whole's picture, error from the oracle's over {} pixels on a grid, where a row "
        "claims to be right. What is left out changes the picture; where that changes the rays too the cost "
        "is theirs as well.\n",
        cpu ? "the processor" : "the clock", settings.rounds, settings.error_pixels);
    for (const ProfileTime& row : p.times)
        if (row.time.meaningless)
            fmt::print(to, "Without {} there are {:.1f} times as many rays, so that it has no row.\n", row.time.name,
                       ratio(row.time.counted.rays, p.counted.rays));
    fmt::print(to,
               "Halves: {} of the scene's bytes are coordinates, {} boxes; half as many would do, and 4 of 7 for "
               "boxes with their references.\n",
               p.coordinate_bytes, p.node_bytes);
    print_stages(to, p, device);
}

void print_fixed(std::FILE* to, const SceneProfile& p)
{
    const FixedCosts& f = p.fixed;
    const double whole = p.times.empty() ? 0 : median(p.times.front().time.real);
    struct Row {
        std::string name;
        double seconds;
    };
    const Row rows[] = {
        {"read the scene", f.read},
        {"compile the scene", f.compile},
        {"build the program, empty cache", f.cold_build},
        {"first launch, empty cache", f.cold_launch},
        {"build, cached", f.cached_build},
        {"first launch, cached", f.cached_launch},
        {fmt::format("upload {} bytes", f.scene_bytes), f.upload},
        {"an empty launch and its buffers", f.empty_launch},
        {fmt::format("launch, and {} bytes on their way back", f.picture_bytes + f.counter_bytes), f.way_back}};
    fmt::print(to, "\n### What does not depend on the rays\n\n| | ms |\n|---|---:|\n");
    for (const Row& row : rows) fmt::print(to, "| {} | {:.3f} |\n", row.name, 1e3 * row.seconds);
    fmt::print(to, "\nBy the clock. The last row is what tracing takes beyond the kernel's own time{}.\n",
               whole > 0 ? fmt::format(", {:.1f} % of the whole", 100 * f.way_back / whole) : "");
}

void print_profile(std::FILE* to, const SceneProfile& p, const ProfileSettings& settings,
                   const host::DeviceInfo& device)
{
    fmt::print(to, "## {}\n\n{}, {}x{}, one sample a pixel, {}, the kernel of {}.\n", p.name, host::describe(device),
               settings.picture.width, settings.picture.height, precision_name(settings.precision),
               p.kernel == host::KernelShape::packets ? "packets" : "pixels");
    if (settings.parts.counts) print_counts(to, p, settings);
    if (settings.parts.times) print_times(to, p, settings, device);
    if (settings.parts.fixed) print_fixed(to, p);
    if (!p.code.empty() || p.executed) print_code(to, p);
    if (p.executed) print_limits(to, p);
    for (const std::string& note : p.notes) fmt::print(to, "\nMissing: {}.\n", note);
    fmt::print(to, "\n");
}

} // namespace clucida::bench
