/// What was measured becomes the calibration that `clucida render --max-error` goes by.
#pragma once

#include "bench/measure_speed.h"
#include "host/calibration.h"

#include <span>
#include <vector>

namespace clucida::bench {

/// The records for that device: of the contenders on it whose settings' error is known and that `clucida render` can
/// be: without a limit of threads and with a local size that is chosen.
std::vector<host::CalibrationRecord> records_of(std::span<const SceneSpeed> results, const host::DeviceInfo& device);

/// Stores the records of each device. Says on standard error what was stored, unless quiet, and what could not be.
void store_calibrations(std::span<const SceneSpeed> results, const std::vector<host::DeviceInfo>& devices, bool quiet);

} // namespace clucida::bench
