/// What is wrong with a scene and where, as `file:line:column: error: what, and what was expected` with the line.
#pragma once

#include "scene/model.h"

#include <stdexcept>
#include <string>
#include <string_view>

namespace clucida::scene {

class Error : public std::runtime_error {
public:
    /// A message with no place in a text.
    explicit Error(const std::string& what) : std::runtime_error(what) {}
    /// file is as the user named it; text is the whole text, of which the offending line is shown with a caret.
    Error(const std::string& file, Location at, const std::string& what, std::string_view text);
    /// A message at a place whose text is not at hand (the compiler's); `located` adds file and line.
    Error(Location at_, const std::string& what) : std::runtime_error(what), at(at_) {}
    Location at;
};

/// The same with its file and line: for an Error that has a place but was made where the text was not at hand.
Error located(const Error& error, const std::string& file, std::string_view text);

} // namespace clucida::scene
