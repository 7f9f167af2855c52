/// Pictures with many samples and hops to spare, that settings are held against. They are kept, for they take long.
#pragma once

#include "bench/measure_speed.h"
#include "bench/speed_seats.h"

#include <filesystem>
#include <string>

namespace clucida::bench {

/// The reference's view for pictures of that size: four times the most samples that any contender has and at least 64,
/// twice the hops, a sixteenth of the cutoff; of the contenders' or, if they have none, the scene's.
SpeedView reference_view(const std::vector<SpeedContender>& contenders, host::Shape picture,
                         const host::SceneSource& source);

/// The file of the reference: in the user's cache (cache_folder()/references), rendered if it is not there, or there
/// and broken; in `folder`, which is for a while, where there is no cache. Its name is a digest of what the device is
/// given (photographs too), of the precision and of this program's version. folder also has the compiled kernels.
/// @throws host::Failure, host::UsageError, host::Interrupted, scene::Error
std::filesystem::path reference_file(const host::SceneSource& source, const host::SceneOptions& scene,
                                     const SpeedSettings& settings, const SpeedView& view,
                                     const std::filesystem::path& folder);

/// "64 samples a pixel, 38 hops, a cutoff of 0.00024, double"
std::string describe_reference(const SpeedView& view, host::Precision precision);

} // namespace clucida::bench
