/// Endings of files' names, and what they stand for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace clucida::host {

/// What follows a name's last dot, or all of it, in small letters.
std::string lower_ending(std::string_view name);

template <typename Format>
struct FileEnding {
    std::string_view ending; ///< in small letters
    Format format;
};

/// By the ending of a file's name, or by the ending alone ("png"); whatever the case.
template <typename Format>
std::optional<Format> format_of(std::string_view name, std::span<const FileEnding<Format>> endings)
{
    const std::string ending = lower_ending(name);
    for (const FileEnding<Format>& e : endings)
        if (e.ending == ending) return e.format;
    return std::nullopt;
}

/// For messages: "png, jpg, ...".
template <typename Format>
std::string listed(std::span<const FileEnding<Format>> endings)
{
    std::string out;
    for (const FileEnding<Format>& e : endings) out.append(out.empty() ? "" : ", ").append(e.ending);
    return out;
}

} // namespace clucida::host
