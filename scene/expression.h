/// Numbers and vectors of clucida's own language: arithmetic by muParser, over constants that `let` defines.
#pragma once

#include "scene/lexer.h"
#include "scene/model.h"
#include "scene/read.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clucida::scene {

class Expressions {
public:
    explicit Expressions(const Moment& moment);
    ~Expressions();
    Expressions(const Expressions&) = delete;
    Expressions& operator=(const Expressions&) = delete;

    /// `NAME = VALUE` at the cursor, after the word let.
    void define(Cursor& cursor);
    /// Likewise after the word parameter: the moment may have another value.
    void define_parameter(Cursor& cursor);
    /// The number of the sequence's frames is known from here on, unless the moment had it.
    void set_sequence(const Sequence& sequence);
    /// @throws Error for a parameter of the moment's that was not defined
    void check_parameters(const Source& source) const;
    const Usage& usage() const { return usage_; }

    /// What an error says was expected is made of two pieces, so that only an error joins them.
    double number(Cursor& cursor, std::string_view expected = "a number", std::string_view and_more = {});
    Vec3 vector(Cursor& cursor, std::string_view expected = "a vector [x, y, z]", std::string_view and_more = {});
    /// A vector, or a number for all three of its coordinates.
    Vec3 vector_or_number(Cursor& cursor, std::string_view expected);
    /// Whether a vector stands at the cursor.
    bool at_vector(Cursor& cursor) const;

private:
    struct Parser; // keeps muParser out of this header
    using Value = std::variant<double, Vec3>;
    std::string new_name(Cursor& cursor, std::string_view what, Location& at);
    Value value(Cursor& cursor);
    void keep(const std::string& name, Location at, const Value& value);
    Value given_value(const std::string& name, const std::string& text);
    void define_time();
    double evaluate(Cursor& cursor, const Extent& extent);
    void check_words(Cursor& cursor, const Extent& extent);

    std::unique_ptr<Parser> parser_;
    std::map<std::string, Vec3, std::less<>> vectors_;
    std::map<std::string, std::size_t, std::less<>> lines_; ///< where each name was defined
    Moment moment_;
    Sequence sequence_;
    std::vector<std::string> parameters_; ///< those that were defined
    Usage usage_;
};

} // namespace clucida::scene
