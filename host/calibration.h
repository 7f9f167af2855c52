/// What `clucida-bench` has measured on a device: how long settings take, and how far their pictures are from right.
/// Kept in a file for each device in cache_folder()/calibration.
#pragma once

#include "host/device_choice.h"
#include "host/program.h"
#include "host/tiling.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clucida::host {

/// What can be chosen to trade time for accuracy.
struct QualitySettings {
    Precision precision = Precision::single;
    unsigned samples = 1;                  ///< of a pixel
    std::optional<unsigned> max_hops = {}; ///< else the scene's
    std::optional<double> cutoff = {};     ///< likewise
    bool operator==(const QualitySettings&) const = default;
};

/// One scene's picture by one setting. Errors are in linear light, against a reference of many more samples, twice the
/// hops and a sixteenth of the cutoff.
struct CalibrationRecord {
    std::string scene;           ///< its name, for people
    std::string hash;            ///< SHA-256 of its text
    std::string kernel = "auto"; ///< as --kernel has it
    Shape picture;
    QualitySettings settings;
    double seconds_per_pixel = 0;
    double rmse = 0, p999 = 0, max_error = 0;
};

/// Empty where there is no home for caches. Its name is a digest of the device, its driver and platform, and of this
/// program's version.
std::filesystem::path calibration_file(const DeviceInfo& device);

/// The device's records; none if there is no file. A file that is broken counts as none, and *problem, unless nullptr,
/// says what is wrong with it.
std::vector<CalibrationRecord> load_calibration(const DeviceInfo& device, std::string* problem = nullptr);

/// Adds to the device's records; a newer one of the same scene, kernel, picture's size and settings replaces the older.
/// The file appears whole or not at all. @throws Failure
void store_calibration(const DeviceInfo& device, const std::vector<CalibrationRecord>& records);

} // namespace clucida::host
