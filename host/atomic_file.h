/// A file that appears whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace clucida::host {

/// Checks, before any work is done, that a file of this name could be written. @throws Failure saying why not
void require_writable(const std::filesystem::path& file);

/// Writes the file: a temporary name in the same folder, flushed to the disk, then renamed; on failure the temporary
/// file is removed. What exists and is no regular file (a device, a pipe) is written to directly.
/// @throws Failure with the system's reason
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Writes all bytes to a descriptor, such as standard output. name is for the error. @throws Failure
void write_all(int descriptor, std::string_view bytes, const std::string& name);

/// The whole file. @throws Failure with the system's reason
std::string read_file(const std::filesystem::path& file);

} // namespace clucida::host
