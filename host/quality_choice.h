/// The fastest settings that calibration lets expect to be near enough to right.
#pragma once

#include "host/calibration.h"

#include <optional>
#include <span>
#include <string>

namespace clucida::host {

/// What is asked for. Settings that are fixed are not chosen.
struct QualityRequest {
    double max_error = 0; ///< RMSE in linear light, above 0
    std::string hash;     ///< of the scene's text; empty: not known
    std::string kernel = "auto";
    Shape picture;
    std::optional<Precision> precision = {};
    std::optional<unsigned> samples = {}, max_hops = {};
    std::optional<double> cutoff = {};
};

struct QualityChoice {
    QualitySettings settings;
    double expected = 0;    ///< RMSE
    std::size_t scenes = 0; ///< whose worst that is; 0: it was measured on this very scene
    bool suffices = false;  ///< else it is the most accurate of what is known
};

constexpr std::size_t least_scenes = 3; ///< on which settings are known well enough for another scene

/// From records of this very scene, if there are any (of this size of picture, if there are any such; else the worst of
/// all sizes). Otherwise from settings that were measured on least_scenes scenes or more with the scenes' own hops and
/// cutoff, the worst of which is expected. Nothing if there are no such records.
std::optional<QualityChoice> choose_quality(std::span<const CalibrationRecord> records, const QualityRequest& request);

/// "calibrated on this scene", "the worst of 5 calibrated scenes"
std::string describe_source(const QualityChoice& choice);

} // namespace clucida::host
