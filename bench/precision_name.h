/// A precision as options and reports have it.
#pragma once

#include "host/program.h"

namespace clucida::bench {

inline const char* precision_name(host::Precision precision)
{
    return precision == host::Precision::twofold ? "double" : "float";
}

} // namespace clucida::bench
