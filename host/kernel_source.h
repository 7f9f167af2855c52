/// The kernels' text, as embedded in the program.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::host {

/// The text of a file by its path ("kernels/vec.h"), or nothing if there is none.
using FileTexts = std::function<std::optional<std::string_view>(const std::string& path)>;

/// The text of an embedded file.
std::optional<std::string_view> embedded_kernel(const std::string& path);

/// The paths of all embedded files.
std::vector<std::string> embedded_kernel_paths();

/// One text out of `entry` and whatever it includes, each file once, with #line directives, so that build logs name
/// the true file and line. Left as they are: includes in angle brackets, includes that name no known file, and
/// whatever stands in a block that OpenCL compilers skip (#ifndef __OPENCL_VERSION__).
/// @throws std::runtime_error if there is no such entry
std::string resolve_includes(const std::string& entry, const FileTexts& files);

/// The same over the embedded files: kernel_source("kernels/render.cl").
std::string kernel_source(const std::string& entry);

} // namespace clucida::host
