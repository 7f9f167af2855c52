#include "host/build_log.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

namespace clucida::host {
namespace {

/// A line of the source under the name that #line directives give it.
struct Place {
    std::string file; ///< empty before the first directive
    unsigned line = 0;
};

std::optional<unsigned> number(std::string_view text)
{
    unsigned out = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return out;
}

/// `#line 12 "file"`, or nothing.
std::optional<Place> directive(std::string_view text)
{
    constexpr std::string_view word = "#line ";
    const auto open = text.find('"'), close = text.rfind('"');
    if (!text.starts_with(word) || open == std::string_view::npos || close <= open + 1) return std::nullopt;
    const auto line = number(text.substr(word.size(), text.find(' ', word.size()) - word.size()));
    if (!line) return std::nullopt;
    return Place{std::string(text.substr(open + 1, close - open - 1)), *line};
}

/// Of every line of the source, from the first.
std::vector<Place> places_of(const std::string& source)
{
    std::vector<Place> out;
    std::istringstream lines(source);
    std::string text;
    Place next{"", 1};
    while (std::getline(lines, text)) {
        out.push_back(next);
        next.line++;
        if (const auto given = directive(text)) next = *given;
    }
    return out;
}

/// What stands before a line's number when it is one of the whole source: a name in angle brackets, or none.
bool names_source(std::string_view name)
{
    return name.empty() || (name.front() == '<' && name.back() == '>');
}

std::string with_file(const std::string& text, const std::vector<Place>& places)
{
    const auto colon = text.find(':');
    if (colon == std::string::npos) return text;
    std::string_view name = std::string_view(text).substr(0, colon), rest = std::string_view(text).substr(colon + 1);
    if (number(name)) { // no name, and no colon either
        name = {};
        rest = text;
    }
    const auto end = rest.find(':');
    if (!names_source(name) || end == std::string_view::npos) return text;
    const auto line = number(rest.substr(0, end));
    if (!line || *line < 1 || *line > places.size() || places[*line - 1].file.empty()) return text;
    const Place& place = places[*line - 1];
    return fmt::format("{}:{}{}", place.file, place.line, rest.substr(end));
}

} // namespace

std::string name_files(const std::string& log, const std::string& source)
{
    const std::vector<Place> places = places_of(source);
    std::istringstream lines(log);
    std::string out, text;
    while (std::getline(lines, text)) out += with_file(text, places) + "\n";
    return out;
}

std::string summarise_log(const std::string& log)
{
    constexpr int most = 20;
    std::istringstream lines(log);
    std::string out, line;
    int count = 0;
    while (std::getline(lines, line)) {
        if (line.find("error:") == std::string::npos) continue;
        if (++count <= most) out += "  " + line + "\n";
    }
    if (count > most) out += fmt::format("  ... and {} more\n", count - most);
    if (!out.empty()) out.pop_back();
    return out;
}

} // namespace clucida::host
