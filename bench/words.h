/// Small questions about text.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace clucida::bench {

inline bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> beginnings)
{
    return std::ranges::any_of(beginnings, [&](std::string_view b) { return text.starts_with(b); });
}

inline bool is_any(std::string_view text, std::initializer_list<std::string_view> words)
{
    return std::ranges::find(words, text) != words.end();
}

inline bool contains(std::string_view text, std::string_view part)
{
    return text.find(part) != std::string_view::npos;
}

} // namespace clucida::bench
