/// What a compiler of kernels says, for people.
#pragma once

#include <string>

namespace clucida::host {

/// The log with the true file and line wherever the compiler tells a line of the whole source: of lines that begin with
/// "<kernel>:12:7:", ":12:7:", "12:7:" or the like, as compilers do that pass over the source's #line directives. What
/// names a file of a directive is left alone.
std::string name_files(const std::string& log, const std::string& source);

/// The lines of a build log that tell of errors, the first few of them.
std::string summarise_log(const std::string& log);

} // namespace clucida::host
