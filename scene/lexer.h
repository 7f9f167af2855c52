/// A cursor through a text of clucida's own language: white space, comments, words, strings and brackets.
#pragma once

#include "scene/model.h"
#include "scene/read_common.h"

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::scene {

/// The text of an arithmetic expression. Line ends and comments in it are blanks, offsets are the source's.
struct Extent {
    std::string text;
    Location at;
    std::string_view raw; ///< as in the source
    Location place(std::size_t offset) const;
};

class Cursor {
public:
    explicit Cursor(const Source& source) : source_(source) {}

    const Source& source() const { return source_; }
    Location here() const { return {line_, at_ - line_start_ + 1}; }
    bool at_end() const { return at_ >= source_.text.size(); }
    char peek() const { return at_end() ? '\0' : source_.text[at_]; }

    /// Skips blanks and comments, and within ( ) and [ ] line ends as well.
    void skip_blanks();
    /// Skips line ends, too, wherever it stands.
    void skip_lines();
    /// Skips line ends and semicolons: whatever may stand between two statements.
    void skip_separators();

    /// The next character, after blanks, is taken if it is c.
    bool accept(char c);
    /// why tells what it is for, and may have a {} in it for of: the text is made only if it is needed.
    void expect(char c, fmt::format_string<std::string_view> why, std::string_view of = {});
    /// Opening brackets are remembered until they are closed; one that never is makes the error at the text's end.
    void open(char bracket, fmt::format_string<std::string_view> why, std::string_view of = {});
    bool accept_close(char bracket);
    void close(char bracket);
    /// A line end, a semicolon, the end of the text or a closing brace must follow.
    void end_statement();

    /// The identifier after blanks, or nothing.
    std::string_view word();
    std::string_view peek_word();
    /// A "quoted" string; \" and \\ stand for " and \.
    std::string string(std::string_view expected);
    /// Everything up to where an arithmetic expression must end.
    Extent extent();

    [[noreturn]] void fail(Location at, const std::string& what) const { source_.fail(at, what); }
    /// "expected ..., found ..." here, or an unclosed bracket where the text ended too early.
    [[noreturn]] void fail_expected(std::string_view expected) const;

private:
    struct Bracket {
        char character;
        Location at;
    };

    void step();
    void skip(bool lines, bool semicolons);
    bool in_brackets() const { return !open_.empty() && open_.back().character != '{'; }
    std::string found() const;

    const Source& source_;
    std::size_t at_ = 0, line_ = 1, line_start_ = 0;
    std::vector<Bracket> open_;
};

bool is_word_start(char c);
bool is_word_part(char c);

} // namespace clucida::scene
