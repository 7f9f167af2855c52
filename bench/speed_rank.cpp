#include "bench/speed_rank.h"

#include "bench/median.h"
#include "bench/precision_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace clucida::bench {
namespace {

constexpr double noticeable = 0.99; ///< an error is less if it is at most that part of another

double seconds(const Ranked& r)
{
    return median(r.report->real);
}

host::Shape size_of(const Ranked& r)
{
    return r.report->contender.view.picture;
}

/// Whether `clucida render` has options for it.
bool can_be_rendered(const SpeedContender& c)
{
    return !is_native(c) && !c.threads && !c.group;
}

/// In the order of their times, the front is each that is nearer to right than all before.
void mark_front(std::vector<Ranked>& sorted)
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        if (i && size_of(sorted[i]) != size_of(sorted[i - 1])) least = std::numeric_limits<double>::infinity();
        const std::optional<double> error = judged_error(*sorted[i].report);
        if (!error || *error >= noticeable * least) continue;
        sorted[i].on_front = true;
        least = *error;
    }
}

template <class Wanted>
std::vector<Ranked> ranked_if(const SceneSpeed& speed, const Wanted& wanted)
{
    std::vector<Ranked> out;
    for (const SpeedReport& r : speed.reports)
        if (r.failure.empty() && !r.real.empty() && wanted(r.contender)) out.push_back({&r, false});
    const auto key = [](const Ranked& r) {
        const host::Shape size = size_of(r);
        return std::tuple(host::area(size), size.width, seconds(r));
    };
    std::ranges::stable_sort(out, [&](const Ranked& a, const Ranked& b) { return key(a) < key(b); });
    mark_front(out);
    return out;
}

} // namespace

std::optional<double> judged_error(const SpeedReport& report)
{
    if (report.settings) return report.settings->rmse;
    if (report.arithmetic) return report.arithmetic->rmse;
    return std::nullopt;
}

std::vector<Ranked> ranked(const SceneSpeed& speed)
{
    return ranked_if(speed, [](const SpeedContender&) { return true; });
}

std::vector<Recommendation> recommend(const SceneSpeed& speed, double max_error)
{
    std::vector<Recommendation> out;
    const std::vector<Ranked> all = ranked_if(speed, can_be_rendered);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i == 0 || size_of(all[i]) != size_of(all[i - 1])) out.emplace_back();
        const std::optional<double> error = judged_error(*all[i].report);
        Recommendation& best = out.back();
        if (!error || best.suffices) continue; // for the first that suffices is the fastest
        const bool suffices = *error <= max_error;
        if (suffices || !best.report || *error < *judged_error(*best.report)) best = {all[i].report, suffices};
    }
    return out;
}

std::string render_options(const SpeedContender& c)
{
    const SpeedView& v = c.view;
    std::string out = fmt::format("--device {} --precision {} --samples {} -s {}x{}", c.device,
                                  precision_name(c.precision), v.samples, v.picture.width, v.picture.height);
    if (v.max_hops) out += fmt::format(" --max-hops {}", *v.max_hops);
    if (v.cutoff) out += fmt::format(" --cutoff {}", *v.cutoff);
    if (c.kernel) out += *c.kernel == host::KernelShape::packets ? " --kernel packets" : " --kernel pixels";
    return out;
}

std::string describe(const Recommendation& recommendation, const SceneSpeed& speed, double max_error)
{
    if (!recommendation.report)
        return fmt::format("{}: nothing can be recommended, for no error is known of what `clucida render` can do",
                           speed.name);
    const SpeedReport& r = *recommendation.report;
    const SpeedContender& c = r.contender;
    const std::string command = fmt::format("clucida render {} {}", speed.file, render_options(c));
    const std::string figures = fmt::format("{:.2f} ms, RMSE {:.1e}", 1e3 * median(r.real), *judged_error(r));
    const std::string size = fmt::format("{}, {}x{}", speed.name, c.view.picture.width, c.view.picture.height);
    if (recommendation.suffices)
        return fmt::format("{}: fastest with an RMSE of at most {:g}: {} ({})", size, max_error, command, figures);
    return fmt::format("{}: none has an RMSE of at most {:g}; the most accurate: {} ({})", size, max_error, command,
                       figures);
}

} // namespace clucida::bench
