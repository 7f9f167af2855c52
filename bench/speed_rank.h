/// Which settings are worth their time: ranks, the front of speed and error, a recommendation.
#pragma once

#include "bench/measure_speed.h"

#include <optional>
#include <string>
#include <vector>

namespace clucida::bench {

/// The RMSE that settings are judged by: that of the settings if it was measured, else the arithmetic's, else nothing.
std::optional<double> judged_error(const SpeedReport& report);

struct Ranked {
    const SpeedReport* report = nullptr;
    bool on_front = false; ///< none of the same size is both faster and, to a hundredth, as near to right
};

/// A scene's reports that did not fail: the smallest pictures first, of one size the fastest first.
std::vector<Ranked> ranked(const SceneSpeed& speed);

/// The fastest of those given whose error is at most that; else the most accurate one.
struct Recommendation {
    const SpeedReport* report = nullptr; ///< none where no error is known
    bool suffices = false;
};

/// One for each size of picture, the smallest first; of what `clucida render` has options for: no native build, no
/// limit of threads, no local size.
std::vector<Recommendation> recommend(const SceneSpeed& speed, double max_error);

/// "--device 0:0 --precision float --samples 4 --max-hops 8 -s 320x180": what makes `clucida render` do the same.
std::string render_options(const SpeedContender& contender);

/// "glass.clu, 320x180: fastest with an RMSE of at most 0.01: clucida render ... (3.2 ms, RMSE 4.0e-03)"
std::string describe(const Recommendation& recommendation, const SceneSpeed& speed, double max_error);

} // namespace clucida::bench
