#include "host/workarounds.h"

namespace clucida::host {

bool copies_calls(const DeviceInfo& device)
{
    return !device.has_fma;
}

std::string workaround_options(const DeviceInfo& device)
{
    // At each fma stands a routine of integers, which kernels/fused.h does with sums and products; and the quick search
    // is left out, as the full one finds the same without it.
    return copies_calls(device) ? " -DCLU_NO_FMA -DCLU_FULL_SEARCH" : "";
}

} // namespace clucida::host
