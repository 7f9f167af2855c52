#include "host/workarounds.h"

#include "host/tiling.h"

namespace clucida::host {

bool copies_calls(const DeviceInfo& device)
{
    return !device.has_fma;
}

unsigned most_samples_of_launch(const DeviceInfo& device)
{
    return copies_calls(device) ? 1 : samples_per_launch;
}

std::string explain_stuck(const DeviceInfo& device)
{
    return copies_calls(device)
               ? "the device ends loops before they are done: the pixels that it counts as stuck are wrong; "
                 "a smaller --max-hops may help"
               : "";
}

std::string workaround_options(const DeviceInfo& device)
{
    // At each fma stands a routine of integers, which kernels/fused.h does with sums and products; the quick search is
    // left out, as the full one finds the same without it; and whether all loops came to their ends is looked at.
    return copies_calls(device) ? " -DCLU_NO_FMA -DCLU_FULL_SEARCH -DCLU_LIMITED_LOOPS" : "";
}

} // namespace clucida::host
