/// Ablations rendered in turns, and what they tell.
#pragma once

#include "bench/ablations.h"
#include "host/compare.h"

#include <functional>
#include <vector>

namespace clucida::bench {

struct AblationTime {
    std::string name;
    How how = How::whole;
    Stage stage = Stage::none;
    bool meaningless = false;              ///< there are more rays without it than with it: it was not timed
    std::vector<double> real, device, cpu; ///< of each round, s: the clock's, the device's own, the processor's
    /// Of the time that counts: against the whole of the same round, s; what is left out or done twice costs as much.
    double cost = 0, cost_spread = 0;
    double share = 0; ///< of the whole
    double ratio = 1; ///< of its time to the whole's, the median of the rounds'
    double each = 0;  ///< ns of the cost for each of what it is counted by; 0: there is none
    host::Statistics counted;
    host::Picture picture;
    host::Comparison change; ///< of the picture from the whole's
};

/// Which time counts: of a device on the host's own processors theirs, for others may use them too; else the clock's.
bool counts_by_processor(const host::DeviceInfo& device);

/// The time that counts of each round, s.
const std::vector<double>& counting_times(const AblationTime& time, const host::DeviceInfo& device);

/// Each ablation is rendered once before the rounds, in which they take turns; the first is the whole. What is left out
/// has no cost if more rays are traced without it. progress: 0..1.
/// @throws host::Failure, host::Interrupted
std::vector<AblationTime> time_ablations(const host::Device& device, std::vector<Ablation> ablations, unsigned rounds,
                                         const std::function<void(double)>& progress);

} // namespace clucida::bench
