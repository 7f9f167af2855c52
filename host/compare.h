/// How far two pictures are apart.
#pragma once

#include "host/picture.h"
#include "host/plane.h"

#include <cstdint>
#include <vector>

namespace clucida::host {

/// The least of the values that a share of them does not exceed; reorders them. Nearest rank: no interpolation. 0 if
/// there are none.
double percentile(std::vector<double>& values, double share);

struct Comparison {
    std::uint64_t pixels = 0;
    double rmse = 0;                                ///< over all channels, linear light
    double psnr = 0;                                ///< dB, for a peak of 1; infinite for equal pictures
    double mean_error = 0;                          ///< of the absolute differences
    double max_error = 0;                           ///< the largest absolute difference
    double p50 = 0, p99 = 0, p999 = 0;              ///< of all absolute differences 50, 99, 99.9 % are at most this
    unsigned max_x = 0, max_y = 0, max_channel = 0; ///< where that is; channel 0 is red
    std::uint64_t over = 0;                         ///< pixels of which a channel differs by more than the threshold
    std::uint64_t not_numbers = 0; ///< channels that are NaN in either picture; left out of all the above
};

/// The same after development to 8-bit sRGB.
struct ByteComparison {
    unsigned max_steps = 0;
    double mean_steps = 0;
    std::uint64_t equal = 0; ///< pixels that are the same
};

/// @throws Failure if the sizes differ
void require_same_size(const Picture& a, const Picture& b);

/// @throws Failure if the sizes differ
Comparison compare(const Picture& a, const Picture& b, double threshold);
ByteComparison compare_bytes(const Picture& a, const Picture& b, Transfer transfer = Transfer::srgb);

/// The largest absolute difference of each pixel's channels; NaN where one of them is not a number.
/// @throws Failure if the sizes differ
Plane error_map(const Picture& a, const Picture& b);

} // namespace clucida::host
