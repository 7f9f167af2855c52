/// Solid expressions of clucida's own language: primitives, transforms and boolean operators over named solids.
#pragma once

#include "scene/expression.h"
#include "scene/lexer.h"
#include "scene/model.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::scene {

/// A solid with what it costs: how deep it is nested and how many primitives it has when names are replaced.
struct Measured {
    SolidPtr solid;
    std::size_t depth = 1, members = 1;
};

class SolidReader {
public:
    SolidReader(Cursor& cursor, Expressions& expressions) : cursor_(cursor), expressions_(expressions) {}

    /// `NAME = EXPRESSION` at the cursor, after the word solid.
    void define();
    SolidPtr read();

    /// Words that name no solid of the user's.
    static const std::vector<std::string_view>& reserved();

private:
    struct Named {
        Measured solid;
        std::size_t line = 0;
    };
    struct Arguments;

    Measured any_of();
    Measured difference();
    Measured all_of();
    Measured unary();
    Measured unary_here();
    Measured named(std::string_view word, Location at);
    Measured primitive(std::string_view word, Location at);
    Measured transform(std::string_view word, Location at);
    bool accept_operator(char c, Location& at);
    Measured bounded(const Measured& solid, Location at) const;

    Cursor& cursor_;
    Expressions& expressions_;
    std::map<std::string, Named, std::less<>> named_;
    std::size_t nesting_ = 0;
};

} // namespace clucida::scene
