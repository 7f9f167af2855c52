/// The shape of work-groups that a device is fastest with: measured once, and kept.
#pragma once

#include "host/device_choice.h"
#include "host/tracer.h"

#include <functional>
#include <optional>
#include <vector>

namespace clucida::host {

/// The shape that was kept for a device. A file that is broken is as good as none.
std::optional<Shape> kept_group(const DeviceInfo& device);
/// False if it cannot be kept.
bool keep_group(const DeviceInfo& device, Shape group);

/// Shapes worth trying of at most so many work-items: how long a group is decides what is traced side by side.
std::vector<Shape> candidate_groups(std::size_t most_items);

/// A look at groups: the seconds that a region in the middle of the picture takes, with groups of that shape. None
/// where it cannot be had.
using TimeGroup = std::function<std::optional<double>(Shape group)>;

/// The fastest of the candidates; `usual` unless another is clearly faster. Ends early where looks take long: some
/// implementations compile anew for each shape.
Shape fastest_group(Shape usual, const std::vector<Shape>& candidates, const TimeGroup& seconds);

/// Seconds of the best of so many launches (at least one) of a region's first sample. @throws cl::Error, Failure
double least_seconds(Lane& lane, const Region& region, unsigned looks);

/// Seconds of the best of a few launches over a region of about so many pixels in the picture's middle. @throws
/// cl::Error
double time_middle(Tracer& tracer, Shape picture, std::size_t pixels);

} // namespace clucida::host
