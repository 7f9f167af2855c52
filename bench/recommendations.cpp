#include "bench/recommendations.h"

#include "bench/median.h"
#include "bench/precision_name.h"
#include "bench/speed_rank.h"
#include "bench/speed_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace clucida::bench {
namespace {

std::string brief(const SpeedReport& r)
{
    const SpeedContender& c = r.contender;
    std::string out = fmt::format("{} {}, {} sample{}", c.device, precision_name(c.precision), c.view.samples,
                                  c.view.samples == 1 ? "" : "s");
    if (c.kernel) out += fmt::format(", {}", kernel_name(c.kernel));
    if (c.view.max_hops) out += fmt::format(", {} hops", *c.view.max_hops);
    if (c.view.cutoff) out += fmt::format(", cutoff {}", *c.view.cutoff);
    return fmt::format("{}: {:.2f} ms", out, 1e3 * median(r.real));
}

/// The rows of one scene: one for each size of picture.
std::vector<std::vector<std::string>> rows_of(const SceneSpeed& scene, std::span<const double> errors)
{
    std::vector<std::vector<std::string>> out;
    for (const double error : errors) {
        const std::vector<Recommendation> by_size = recommend(scene, error);
        out.resize(by_size.size(), {scene.name});
        for (std::size_t i = 0; i < by_size.size(); ++i)
            out[i].push_back(by_size[i].suffices ? brief(*by_size[i].report) : "none");
    }
    return out;
}

} // namespace

Table recommendation_table(std::span<const SceneSpeed> results, std::span<const double> errors)
{
    Table out{{"scene"}, {false}, {}};
    for (const double error : errors) {
        out.head.push_back(fmt::format("RMSE of at most {:g}", error));
        out.is_figure.push_back(false);
    }
    const auto has_error = [](const SpeedReport& r) { return judged_error(r).has_value(); };
    for (const SceneSpeed& scene : results)
        if (std::ranges::any_of(scene.reports, has_error))
            for (auto& row : rows_of(scene, errors)) out.rows.push_back(std::move(row));
    return out;
}

} // namespace clucida::bench
