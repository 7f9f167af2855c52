#include "bench/error_output.h"

#include "bench/precision_name.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <thread>

namespace clucida::bench {
namespace {

constexpr std::size_t most_listed = 4; ///< flips, in the text

double per_million(double count, const ErrorReport& r)
{
    return 1e6 * count / static_cast<double>(r.pixels);
}

/// The weight that a picture's pixel lost to cutoff and hop limit, in the mean.
double truncated(const ErrorReport& r)
{
    return static_cast<double>(r.statistics.truncated) * 0x1p-16 / static_cast<double>(r.pixels);
}

double million_rays_a_second(const ErrorReport& r)
{
    return static_cast<double>(r.statistics.rays) / (1e3 * r.milliseconds);
}

std::uint64_t overflows(const host::Statistics& s)
{
    return s.interior_overflow + s.stack_overflow;
}

/// The decibels of a ratio; equal pictures have no end of them.
std::string decibels(double psnr)
{
    return std::isfinite(psnr) ? fmt::format("{:.1f}", psnr) : "inf";
}

void print_cost(std::FILE* to, const char* what, const Cost& cost)
{
    fmt::print(to, "  {:<22} rmse {:.2g}, max {:.2g}, psnr {} dB; {:.4f} % equal in 8 bits\n", what, cost.rmse,
               cost.max_error, decibels(cost.psnr), 100 * cost.equal);
}

void print_report(std::FILE* to, const ErrorReport& r)
{
    const host::Statistics& s = r.statistics;
    fmt::print(to, "  {} {}\n", precision_name(r.contender.precision), r.contender.variant);
    fmt::print(to, "    time       {:.2f} ms ({:.2f} to {:.2f}), {:.2f} million rays a second\n", r.milliseconds,
               r.fastest, r.slowest, million_rays_a_second(r));
    fmt::print(to, "    kernel     p50 {:.2f}, p99.9 {:.2f}, worst {:.2f} units of rounding; {} of {} rays wrong\n",
               r.kernel.p50, r.kernel.p999, r.kernel.worst, r.kernel.wrong, r.kernel.rays);
    fmt::print(to, "    flips      {} of {} pixels, {:.4g} per million, {} within four hops\n", r.flips, r.pixels,
               per_million(static_cast<double>(r.flips), r), r.shallow_flips);
    const Explained& e = r.explained;
    fmt::print(to, "               of {} looked at {} explained, {} of them step by step; {} unexplained\n",
               e.looked_at, e.explained, e.step_by_step, e.unexplained.size());
    for (const UnexplainedFlip& flip : std::span(e.unexplained).first(std::min(e.unexplained.size(), most_listed)))
        fmt::print(to, "               unexplained at {},{}, {}\n", flip.pixel.x, flip.pixel.y, flip.why);
    fmt::print(to, "    agreeing   max {:.2g}, p99.9 {:.2g}, rmse {:.2g}, psnr {} dB; {:.4f} % equal in 8 bits\n",
               r.agreeing.max_error, r.agreeing.p999, r.agreeing.rmse, decibels(r.agreeing.psnr),
               100 * r.agreeing_equal);
    fmt::print(to, "    all        max {:.2g}, rmse {:.2g}, psnr {} dB, mean FLIP {:.2g}\n", r.all.max_error,
               r.all.rmse, decibels(r.all.psnr), r.flip);
    fmt::print(to, "    faults     parity {}, nan {}, overflows {}, stuck {}\n", s.parity, s.nan, overflows(s),
               s.stuck);
    fmt::print(to, "    truncated  {:.2g} of a pixel's weight in the mean\n", truncated(r));
}

nlohmann::ordered_json number(double x)
{
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json cost_json(const Cost& c)
{
    return {{"rmse", c.rmse}, {"max_error", c.max_error}, {"psnr", number(c.psnr)}, {"equal_8_bit", c.equal}};
}

nlohmann::ordered_json report_json(const NamedError& of, const ErrorReport& r, const ErrorSettings& settings)
{
    const host::Statistics& s = r.statistics;
    nlohmann::ordered_json unexplained = nlohmann::ordered_json::array(), why = nlohmann::ordered_json::array();
    for (const UnexplainedFlip& flip : r.explained.unexplained) {
        unexplained.push_back({flip.pixel.x, flip.pixel.y});
        why.push_back(flip.why);
    }
    nlohmann::ordered_json j = {
        {"name", fmt::format("error/{}/{}/{}/{}x{}", of.scene, precision_name(r.contender.precision),
                             r.contender.variant, settings.picture.width, settings.picture.height)},
        {"run_type", "iteration"},
        {"repetitions", settings.repeats},
        {"iterations", settings.repeats},
        {"real_time", r.milliseconds},
        {"time_unit", "ms"},
        {"fastest", r.fastest},
        {"slowest", r.slowest},
        {"mrays_s", million_rays_a_second(r)},
        {"device", r.device},
        {"pixels", r.pixels},
        {"flips", r.flips},
        {"flips_ppm", per_million(static_cast<double>(r.flips), r)},
        {"flips_within_4_hops_ppm", per_million(static_cast<double>(r.shallow_flips), r)},
        {"flips_looked_at", r.explained.looked_at},
        {"explained_flips", r.explained.explained},
        {"explained_step_by_step", r.explained.step_by_step},
        {"unexplained_flips", unexplained_flips(r)},
        {"unexplained_at", std::move(unexplained)},
        {"unexplained_why", std::move(why)},
        {"max_error", r.agreeing.max_error},
        {"p999", r.agreeing.p999},
        {"rmse", r.agreeing.rmse},
        {"psnr", number(r.agreeing.psnr)},
        {"equal_8_bit", r.agreeing_equal},
        {"all_max_error", r.all.max_error},
        {"all_rmse", r.all.rmse},
        {"all_psnr", number(r.all.psnr)},
        {"mean_flip", r.flip},
        {"kernel_rays", r.kernel.rays},
        {"kernel_wrong", r.kernel.wrong},
        {"kernel_p50", r.kernel.p50},
        {"kernel_p999", r.kernel.p999},
        {"kernel_worst", r.kernel.worst},
        {"parity", s.parity},
        {"nan", s.nan},
        {"overflows", overflows(s)},
        {"stuck", s.stuck},
        {"truncated", truncated(r)}};
    if (settings.costs) {
        j["cost_of_rounding"] = cost_json(of.error.rounding);
        j["cost_of_colors"] = cost_json(of.error.colors);
        j["cost_of_cutoff"] = cost_json(of.error.cutoff);
        j["cost_of_hops"] = cost_json(of.error.hops);
    }
    return j;
}

} // namespace

void print_error(std::FILE* to, const NamedError& result, const ErrorSettings& settings)
{
    fmt::print(to, "{}, {}x{}\n", result.scene, settings.picture.width, settings.picture.height);
    for (const ErrorReport& r : result.error.reports) print_report(to, r);
    if (!settings.costs) return;
    print_cost(to, "cost of one rounding", result.error.rounding);
    print_cost(to, "cost of 32-bit filters", result.error.colors);
    print_cost(to, "cost of the cutoff", result.error.cutoff);
    print_cost(to, "cost of the hop limit", result.error.hops);
}

void print_tables(std::FILE* to, std::span<const NamedError> results, const ErrorSettings& settings)
{
    fmt::print(to,
               "| scene | precision | variant | ms | flips, ppm | within 4 hops | step by step | unexplained "
               "| max | p99.9 | RMSE | PSNR, dB | equal, % | PSNR of all | mean FLIP | hit error, u | parity | NaN |\n"
               "|---|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const NamedError& result : results)
        for (const ErrorReport& r : result.error.reports)
            fmt::print(to,
                       "| {} | {} | {} | {:.1f} | {:.4g} | {:.4g} | {} | {:.0f} | {:.1e} | {:.1e} | {:.1e} | {} | "
                       "{:.4f} | {} | {:.1e} | {:.1f} | {} | {} |\n",
                       result.scene, precision_name(r.contender.precision), r.contender.variant, r.milliseconds,
                       per_million(static_cast<double>(r.flips), r),
                       per_million(static_cast<double>(r.shallow_flips), r), r.explained.step_by_step,
                       unexplained_flips(r), r.agreeing.max_error, r.agreeing.p999, r.agreeing.rmse,
                       decibels(r.agreeing.psnr), 100 * r.agreeing_equal, decibels(r.all.psnr), r.flip, r.kernel.worst,
                       r.statistics.parity, r.statistics.nan);
    if (!settings.costs) return;
    fmt::print(
        to,
        "\n| scene | one rounding: RMSE | max | equal, % | truncated | 32-bit filters: RMSE | max | cutoff: RMSE | max "
        "| hop limit: RMSE | max |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const NamedError& result : results) {
        const SceneError& e = result.error;
        fmt::print(
            to, "| {} | {:.1e} | {:.1e} | {:.4f} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n",
            result.scene, e.rounding.rmse, e.rounding.max_error, 100 * e.rounding.equal, truncated(e.reports.front()),
            e.colors.rmse, e.colors.max_error, e.cutoff.rmse, e.cutoff.max_error, e.hops.rmse, e.hops.max_error);
    }
}

nlohmann::ordered_json error_json(std::span<const NamedError> results, const ErrorSettings& settings,
                                  const std::string& oracle)
{
    nlohmann::ordered_json out = {{"context",
                                   {{"date", fmt::format("{:%FT%T}Z", fmt::gmtime(std::time(nullptr)))},
                                    {"executable", "clucida-bench"},
                                    {"library_version", CLUCIDA_VERSION},
                                    {"num_cpus", std::thread::hardware_concurrency()},
                                    {"oracle", oracle}}},
                                  {"benchmarks", nlohmann::ordered_json::array()}};
    for (const NamedError& result : results)
        for (const ErrorReport& r : result.error.reports) out["benchmarks"].push_back(report_json(result, r, settings));
    return out;
}

} // namespace clucida::bench
