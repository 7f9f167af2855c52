#include "host/quality_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace clucida::host {
namespace {

using Records = std::vector<const CalibrationRecord*>;

template <class Fits>
Records those(const Records& records, const Fits& fits)
{
    Records out;
    for (const CalibrationRecord* r : records)
        if (fits(*r)) out.push_back(r);
    return out;
}

/// These if there are any, else all.
template <class Fits>
Records rather(const Records& records, const Fits& fits)
{
    const Records out = those(records, fits);
    return out.empty() ? records : out;
}

bool is_allowed(const CalibrationRecord& r, const QualityRequest& request)
{
    const QualitySettings& s = r.settings;
    const auto fits = [](const auto& fixed, const auto& value) { return !fixed || *fixed == value; };
    return r.kernel == request.kernel && fits(request.precision, s.precision) && fits(request.samples, s.samples) &&
           (!request.max_hops || request.max_hops == s.max_hops) && (!request.cutoff || request.cutoff == s.cutoff);
}

/// What records of one setting let expect.
struct Expected {
    QualitySettings settings;
    double error = 0;   ///< the worst
    double seconds = 0; ///< of a pixel, in the mean
    std::set<std::string> scenes;
};

std::vector<Expected> by_settings(const Records& records)
{
    std::vector<Expected> out;
    for (const CalibrationRecord* r : records) {
        auto at = std::ranges::find(out, r->settings, &Expected::settings);
        if (at == out.end()) at = out.insert(out.end(), Expected{r->settings, 0, 0, {}});
        at->error = std::max(at->error, r->rmse);
        at->seconds += r->seconds_per_pixel;
        at->scenes.insert(r->hash);
    }
    for (Expected& e : out) {
        const auto same = [&](const CalibrationRecord* r) { return r->settings == e.settings; };
        e.seconds /= static_cast<double>(std::ranges::count_if(records, same));
    }
    return out;
}

/// The fastest that suffices, else the most accurate.
std::optional<QualityChoice> choose(const std::vector<Expected>& from, double max_error, bool is_this_scene)
{
    if (from.empty()) return std::nullopt;
    const auto merit = [&](const Expected& e) {
        const bool suffices = e.error <= max_error;
        return std::pair(!suffices, suffices ? e.seconds : e.error);
    };
    const Expected& best = *std::ranges::min_element(from, {}, merit);
    return QualityChoice{best.settings, best.error, is_this_scene ? 0 : best.scenes.size(), best.error <= max_error};
}

} // namespace

std::optional<QualityChoice> choose_quality(std::span<const CalibrationRecord> records, const QualityRequest& request)
{
    Records all;
    for (const CalibrationRecord& r : records)
        if (is_allowed(r, request)) all.push_back(&r);

    const Records own = those(all, [&](const auto& r) { return !request.hash.empty() && r.hash == request.hash; });
    if (!own.empty()) {
        const Records sized = rather(own, [&](const auto& r) { return r.picture == request.picture; });
        return choose(by_settings(sized), request.max_error, true);
    }
    const Records plain = those(all, [](const auto& r) { return !r.settings.max_hops && !r.settings.cutoff; });
    std::vector<Expected> known = by_settings(plain);
    std::erase_if(known, [](const Expected& e) { return e.scenes.size() < least_scenes; });
    return choose(known, request.max_error, false);
}

std::string describe_source(const QualityChoice& choice)
{
    if (choice.scenes == 0) return "calibrated on this scene";
    return fmt::format("the worst of {} calibrated scenes", choice.scenes);
}

} // namespace clucida::host
