/// Words of the command line that mean more than a number.
#pragma once

#include "host/tiling.h"

#include <string>
#include <string_view>

namespace clucida::host {

/// "1280x720": two whole numbers from 1. what names it in the error. @throws UsageError
Shape parse_size(std::string_view text, const std::string& what);

/// A picture's size: 1..65536 a side, 2^30 pixels at most. @throws UsageError
Shape parse_picture_size(std::string_view text);

} // namespace clucida::host
