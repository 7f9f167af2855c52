#include "scene/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace clucida::scene {
namespace {

constexpr std::size_t shown_width = 120;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool continues_character(char c)
{
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

std::string_view line_of(std::string_view text, std::size_t line)
{
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    for (; line > 1; --line) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    text = text.substr(0, text.find('\n'));
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
}

/// The line, or a piece of a long one around the column, and a caret beneath the column. Tabs stay, so that the caret
/// stands right whatever their width; other control characters would disturb a terminal.
std::string quote(std::string_view line, std::size_t column)
{
    const std::size_t place = std::min(column > 0 ? column - 1 : 0, line.size());
    std::size_t begin = 0;
    std::size_t end = line.size();
    if (line.size() > shown_width) {
        begin = place > shown_width / 2 ? place - shown_width / 2 : 0;
        end = std::min(line.size(), begin + shown_width);
        while (begin > 0 && begin < place && continues_character(line[begin])) ++begin;
        while (end < line.size() && end > place + 1 && continues_character(line[end])) --end;
    }
    std::string shown = begin > 0 ? "..." : "";
    std::string caret(shown.size(), ' ');
    for (std::size_t i = begin; i < end; ++i) {
        const char c = line[i];
        const bool control = (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
        shown += control ? '?' : c;
        if (i < place && !continues_character(c)) caret += c == '\t' ? '\t' : ' ';
    }
    if (end < line.size()) shown += "...";
    return shown + '\n' + caret + '^';
}

std::string message(const std::string& file, Location at, const std::string& what, std::string_view text)
{
    if (at.line == 0) return fmt::format("{}: error: {}", file, what);
    return fmt::format("{}:{}:{}: error: {}\n{}", file, at.line, at.column, what,
                       quote(line_of(text, at.line), at.column));
}

} // namespace

Error::Error(const std::string& file, Location at_, const std::string& what, std::string_view text)
    : std::runtime_error(message(file, at_, what, text)), at(at_)
{
}

Error located(const Error& error, const std::string& file, std::string_view text)
{
    return {file, error.at, error.what(), text};
}

} // namespace clucida::scene
