#include "bench/speed_calibration.h"

#include "bench/median.h"
#include "bench/speed_axes.h"
#include "bench/speed_words.h"
#include "host/errors.h"

#include <fmt/format.h>

#include <cmath>

namespace clucida::bench {
namespace {

bool serves(const SpeedReport& r, const std::string& selector)
{
    const SpeedContender& c = r.contender;
    return r.failure.empty() && !r.real.empty() && c.device == selector && !c.threads && !c.group && r.settings &&
           std::isfinite(r.settings->rmse) && r.settings->not_numbers == 0;
}

host::CalibrationRecord record_of(const SceneSpeed& scene, const SpeedReport& r)
{
    const SpeedContender& c = r.contender;
    const SpeedView& v = c.view;
    return {scene.name,
            scene.hash,
            kernel_name(c.kernel),
            v.picture,
            {c.precision, v.samples, v.max_hops, v.cutoff},
            median(r.real) / static_cast<double>(host::area(v.picture)),
            r.settings->rmse,
            r.settings->p999,
            r.settings->max_error};
}

} // namespace

std::vector<host::CalibrationRecord> records_of(std::span<const SceneSpeed> results, const host::DeviceInfo& device)
{
    std::vector<host::CalibrationRecord> out;
    for (const SceneSpeed& scene : results)
        for (const SpeedReport& r : scene.reports)
            if (serves(r, host::place(device))) out.push_back(record_of(scene, r));
    return out;
}

void store_calibrations(std::span<const SceneSpeed> results, const std::vector<host::DeviceInfo>& devices, bool quiet)
{
    for (const host::DeviceInfo& device : devices) {
        const std::vector<host::CalibrationRecord> records = records_of(results, device);
        if (records.empty()) continue;
        try {
            host::store_calibration(device, records);
        } catch (const host::Failure& e) {
            fmt::print(stderr, "clucida-bench: warning: the calibration could not be kept: {}\n", e.what());
            continue;
        }
        if (!quiet)
            fmt::print(stderr, "calibrated {}: {} settings of scenes, in {}\n", host::describe(device), records.size(),
                       host::calibration_file(device).string());
    }
}

} // namespace clucida::bench
