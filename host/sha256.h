/// SHA-256 (FIPS 180-4): names of cached programs, and the scene's hash in a picture's metadata.
#pragma once

#include <string>
#include <string_view>

namespace clucida::host {

/// The digest as 64 lower-case hexadecimal digits, as `sha256sum` prints it.
std::string sha256(std::string_view data);

} // namespace clucida::host
