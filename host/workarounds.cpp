#include "host/workarounds.h"

namespace clucida::host {

std::string workaround_options(const DeviceInfo& device)
{
    // Mesa's compiler inlines a routine of integers at each fma of a device that has none: of this program's kernels it
    // makes gigabytes. kernels/fused.h does the same with sums and products.
    return device.has_fma ? "" : " -DCLU_NO_FMA";
}

} // namespace clucida::host
