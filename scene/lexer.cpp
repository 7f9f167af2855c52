#include "scene/lexer.h"

#include "scene/limits.h"

#include <fmt/format.h>

namespace clucida::scene {
namespace {

bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

char closing(char bracket)
{
    return bracket == '(' ? ')' : bracket == '[' ? ']' : '}';
}

} // namespace

bool is_word_start(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_word_part(char c)
{
    return is_word_start(c) || (c >= '0' && c <= '9');
}

Location Extent::place(std::size_t offset) const
{
    Location place = at;
    for (std::size_t i = 0; i < offset && i < raw.size(); ++i) {
        if (raw[i] == '\n') {
            ++place.line;
            place.column = 1;
        } else {
            ++place.column;
        }
    }
    return place;
}

void Cursor::step()
{
    if (peek() == '\n') {
        ++line_;
        line_start_ = at_ + 1;
    }
    ++at_;
}

void Cursor::skip(bool lines, bool semicolons)
{
    while (!at_end()) {
        const char c = peek();
        if (c == '#') {
            while (!at_end() && peek() != '\n') step();
        } else if (is_blank(c) || (lines && c == '\n') || (semicolons && c == ';')) {
            step();
        } else {
            return;
        }
    }
}

void Cursor::skip_blanks()
{
    skip(in_brackets(), false);
}
void Cursor::skip_lines()
{
    skip(true, false);
}
void Cursor::skip_separators()
{
    skip(true, true);
}

bool Cursor::accept(char c)
{
    skip_blanks();
    if (peek() != c || at_end()) return false;
    step();
    return true;
}

void Cursor::expect(char c, fmt::format_string<std::string_view> why, std::string_view of)
{
    if (!accept(c)) fail_expected(fmt::format("'{}' {}", c, fmt::vformat(why, fmt::make_format_args(of))));
}

void Cursor::open(char bracket, fmt::format_string<std::string_view> why, std::string_view of)
{
    skip_blanks();
    const Location at = here();
    expect(bracket, why, of);
    open_.push_back({bracket, at});
}

bool Cursor::accept_close(char bracket)
{
    if (!accept(bracket)) return false;
    open_.pop_back();
    return true;
}

void Cursor::close(char bracket)
{
    if (!accept_close(bracket)) fail_expected(fmt::format("'{}'", bracket));
}

void Cursor::end_statement()
{
    skip_blanks();
    const char c = peek();
    if (at_end() || c == '\n' || c == ';') return;
    if (c == '}' && !open_.empty()) return;
    fail_expected("a new line or ';'");
}

std::string_view Cursor::peek_word()
{
    skip_blanks();
    if (!is_word_start(peek())) return {};
    std::size_t end = at_;
    while (end < source_.text.size() && is_word_part(source_.text[end])) ++end;
    return source_.text.substr(at_, end - at_);
}

std::string_view Cursor::word()
{
    const std::string_view word = peek_word();
    if (word.size() > limits::name_length) {
        fail(here(), fmt::format("a word of {} characters; expected {} at most", word.size(), limits::name_length));
    }
    at_ += word.size();
    return word;
}

std::string Cursor::string(std::string_view expected)
{
    skip_blanks();
    if (peek() != '"') fail_expected(expected);
    const Location at = here();
    step();
    std::string value;
    while (peek() != '"') {
        if (at_end() || peek() == '\n') fail(at, "a string that is never closed; expected '\"' on the same line");
        if (static_cast<unsigned char>(peek()) < ' ' && peek() != '\r') fail(here(), "a control character in a string");
        if (peek() == '\\') {
            step();
            if (peek() != '"' && peek() != '\\') fail(here(), "expected '\"' or '\\' after '\\' in a string");
        }
        value += peek();
        step();
    }
    step();
    return value;
}

Extent Cursor::extent()
{
    skip_blanks();
    const Location at = here();
    const std::size_t begin = at_;
    std::string text;
    std::vector<Location> parentheses;
    while (!at_end()) {
        char c = peek();
        const bool inside = in_brackets() || !parentheses.empty();
        if (!inside && (c == '\n' || c == '#' || c == ',')) break;
        if (c == ';' || c == '{' || c == '}' || c == '[' || c == ']' || c == '"') break;
        if (parentheses.empty() && (c == ',' || c == ')')) break;
        if (c == '(') parentheses.push_back(here());
        if (c == ')') parentheses.pop_back();
        if (c == '#') {
            while (!at_end() && peek() != '\n') {
                text += ' ';
                step();
            }
            continue;
        }
        text += is_blank(c) || c == '\n' ? ' ' : c;
        if (text.size() > limits::expression_length) {
            fail(at, fmt::format("an expression of more than {} characters", limits::expression_length));
        }
        step();
    }
    if (!parentheses.empty()) fail(parentheses.back(), "'(' is never closed; expected ')'");
    while (text.ends_with(' ')) text.pop_back();
    return {std::move(text), at, source_.text.substr(begin, at_ - begin)};
}

std::string Cursor::found() const
{
    if (at_end()) return "the end of the text";
    const char c = peek();
    if (c == '\n') return "the end of the line";
    if (is_word_start(c)) {
        std::size_t end = at_;
        while (end < source_.text.size() && is_word_part(source_.text[end]) && end - at_ < limits::name_length) ++end;
        return fmt::format("'{}'", source_.text.substr(at_, end - at_));
    }
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte >= 0x7F) return fmt::format("the byte {:#04x}", byte);
    return fmt::format("'{}'", c);
}

void Cursor::fail_expected(std::string_view expected) const
{
    if (at_end() && !open_.empty()) {
        const Bracket& bracket = open_.back();
        fail(bracket.at, fmt::format("'{}' is never closed; expected '{}' before the end of the text",
                                     bracket.character, closing(bracket.character)));
    }
    fail(here(), fmt::format("expected {}, found {}", expected, found()));
}

} // namespace clucida::scene
