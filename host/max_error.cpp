#include "host/max_error.h"

#include "host/arguments.h"
#include "host/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace clucida::host {
namespace {

constexpr const char* how_to_calibrate = "`clucida-bench speed SCENE --samples 1,4,16 --precision both --calibrate` or "
                                         "`clucida-bench report` makes one";

QualityRequest request_of(const RenderOptions& o, const std::string& hash, bool has_double)
{
    QualityRequest out;
    out.max_error = *o.max_error;
    if (o.scene.parameters.empty()) out.hash = hash; // with other parameters it is another scene
    out.kernel = o.kernel;
    out.picture = parse_picture_size(o.size);
    if (o.precision_given) out.precision = o.precision == "double" ? Precision::twofold : Precision::single;
    if (!o.precision_given && !has_double) out.precision = Precision::single;
    if (o.samples_given) out.samples = o.samples;
    out.max_hops = o.max_hops;
    out.cutoff = o.cutoff;
    return out;
}

void apply(RenderOptions& o, const QualitySettings& s)
{
    o.precision = s.precision == Precision::twofold ? "double" : "float";
    o.samples = s.samples;
    o.max_hops = s.max_hops;
    o.cutoff = s.cutoff;
}

std::string words_of(const RenderOptions& o)
{
    std::string out = fmt::format("--precision {} --samples {}", o.precision, o.samples);
    if (o.max_hops) out += fmt::format(" --max-hops {}", *o.max_hops);
    if (o.cutoff) out += fmt::format(" --cutoff {}", *o.cutoff);
    return out;
}

} // namespace

void choose_by_error(RenderOptions& o, const std::string& hash)
{
    if (!o.max_error) return;
    if (o.scene.as_original)
        throw UsageError("--max-error is for the optical model, not for --as-original: nothing is known of how far "
                         "imitations are from right");
    const std::vector<Device> devices = find_devices(device_selector(o.device));
    const DeviceInfo device = devices.front().info; // of several, whose pictures are the same, the first was measured
    const bool has_double = std::ranges::all_of(devices, [](const Device& d) { return d.info.has_double; });
    std::string problem;
    const std::vector<CalibrationRecord> records = load_calibration(device, &problem);
    if (!problem.empty()) fmt::print(stderr, "clucida: warning: the calibration {}\n", problem);
    o.error_choice = choose_quality(records, request_of(o, hash, has_double));
    if (!o.error_choice) {
        if (!o.precision_given && has_double) o.precision = "double";
        fmt::print(stderr,
                   "clucida: warning: no calibration of {} tells which error to expect of this; taking {}. {}\n",
                   describe(device), words_of(o), how_to_calibrate);
        return;
    }
    apply(o, o.error_choice->settings);
    const std::string expected =
        fmt::format("RMSE {:.1e}, {}", o.error_choice->expected, describe_source(*o.error_choice));
    if (!o.error_choice->suffices)
        fmt::print(stderr,
                   "clucida: warning: no known setting has an RMSE of at most {:g}; taking the most accurate, "
                   "{} (expected: {})\n",
                   *o.max_error, words_of(o), expected);
    else if (!o.quiet)
        fmt::print(stderr, "taking {} (expected: {})\n", words_of(o), expected);
}

nlohmann::ordered_json error_choice_json(const RenderOptions& o)
{
    using Json = nlohmann::ordered_json;
    if (!o.max_error) return nullptr;
    const auto& choice = o.error_choice;
    return {{"asked", *o.max_error},
            {"expected", choice ? Json(choice->expected) : nullptr},
            {"from", choice ? describe_source(*choice) : "no calibration"},
            {"suffices", choice && choice->suffices},
            {"precision", o.precision},
            {"samples", o.samples},
            {"max_hops", o.max_hops ? Json(*o.max_hops) : nullptr},
            {"cutoff", o.cutoff ? Json(*o.cutoff) : nullptr}};
}

} // namespace clucida::host
