/// Numbers and vectors of clucida's own language: arithmetic by muParser, over constants that `let` defines.
#pragma once

#include "scene/lexer.h"
#include "scene/model.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace clucida::scene {

class Expressions {
public:
    Expressions();
    ~Expressions();
    Expressions(const Expressions&) = delete;
    Expressions& operator=(const Expressions&) = delete;

    /// `NAME = VALUE` at the cursor, after the word let.
    void define(Cursor& cursor);

    /// What an error says was expected is made of two pieces, so that only an error joins them.
    double number(Cursor& cursor, std::string_view expected = "a number", std::string_view and_more = {});
    Vec3 vector(Cursor& cursor, std::string_view expected = "a vector [x, y, z]", std::string_view and_more = {});
    /// A vector, or a number for all three of its coordinates.
    Vec3 vector_or_number(Cursor& cursor, std::string_view expected);
    /// Whether a vector stands at the cursor.
    bool at_vector(Cursor& cursor) const;

private:
    struct Parser; // keeps muParser out of this header
    double evaluate(Cursor& cursor, const Extent& extent);
    void check_words(Cursor& cursor, const Extent& extent) const;

    std::unique_ptr<Parser> parser_;
    std::map<std::string, Vec3, std::less<>> vectors_;
    std::map<std::string, std::size_t, std::less<>> lines_; ///< where each name was defined
};

} // namespace clucida::scene
