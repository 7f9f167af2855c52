#include "scene/expression.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <muParser.h>
#include <numbers>

namespace clucida::scene {

struct Expressions::Parser {
    mu::Parser mu;
};

namespace {

/// The length of the number at the start of text, so that the e of 1e5 is not taken for a name.
std::size_t number_length(std::string_view text)
{
    const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    std::size_t i = 0;
    while (digit(i) || (i < text.size() && text[i] == '.')) ++i;
    if (i > 0 && i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
        std::size_t exponent = i + 1;
        if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
        if (digit(exponent)) {
            while (digit(exponent)) ++exponent;
            return exponent;
        }
    }
    return i;
}

/// muParser's message without its own idea of the place.
std::string message_of(const mu::ParserError& error)
{
    std::string message = error.GetMsg();
    for (const std::string_view tail : {" found at position", " at position", " at expression position"}) {
        if (const std::size_t at = message.find(tail); at != std::string::npos) message.resize(at);
    }
    while (message.ends_with('.') || message.ends_with(' ')) message.pop_back();
    if (!message.empty() && message[0] >= 'A' && message[0] <= 'Z') message[0] += 'a' - 'A';
    return message;
}

/// Where the wrong token begins: muParser points sometimes at it and sometimes behind it.
std::size_t offset_of(const mu::ParserError& error, std::string_view text)
{
    const std::string& token = error.GetToken();
    const auto position = static_cast<std::size_t>(std::clamp(error.GetPos(), 0, static_cast<int>(text.size())));
    if (token.empty() || text.substr(position).starts_with(token)) return position;
    const std::size_t before = text.rfind(token, position);
    return before == std::string_view::npos ? position : before;
}

} // namespace

Expressions::Expressions() : parser_(std::make_unique<Parser>())
{
    parser_->mu.DefineConst("pi", std::numbers::pi);
    parser_->mu.DefineConst("e", std::numbers::e);
    parser_->mu.DefineConst("tau", 2 * std::numbers::pi);
    parser_->mu.DefineFun("floor", static_cast<mu::fun_type1>([](double x) { return std::floor(x); }));
    parser_->mu.DefineFun("ceil", static_cast<mu::fun_type1>([](double x) { return std::ceil(x); }));
}

Expressions::~Expressions() = default;

void Expressions::define(Cursor& cursor)
{
    cursor.skip_blanks();
    const Location at = cursor.here();
    const std::string name(cursor.word());
    if (name.empty()) cursor.fail_expected("a name for the constant");
    if (const auto first = lines_.find(name); first != lines_.end()) {
        cursor.fail(at, fmt::format("'{}' is defined in line {} already", name, first->second));
    }
    if (parser_->mu.GetConst().contains(name) || parser_->mu.GetFunDef().contains(name)) {
        cursor.fail(at, fmt::format("'{}' has a meaning already; expected another name", name));
    }
    cursor.expect('=', "after the constant's name");
    if (at_vector(cursor)) {
        vectors_.emplace(name, vector(cursor));
    } else {
        parser_->mu.DefineConst(name, number(cursor, "a number or a vector [x, y, z]"));
    }
    lines_.emplace(name, at.line);
}

double Expressions::number(Cursor& cursor, std::string_view expected, std::string_view and_more)
{
    const Extent extent = cursor.extent();
    if (extent.text.empty()) cursor.fail_expected(fmt::format("{}{}", expected, and_more));
    const double value = plain_number(extent.text).value_or(NAN);
    if (!std::isnan(value)) {
        check_number(cursor.source(), extent.at, value);
        return value;
    }
    if (number_length(extent.text) == extent.text.size()) {
        cursor.fail(extent.at, fmt::format("'{}' is malformed or out of range; expected a number", extent.text));
    }
    return evaluate(cursor, extent);
}

double Expressions::evaluate(Cursor& cursor, const Extent& extent)
{
    check_words(cursor, extent);
    double value = 0;
    try {
        parser_->mu.SetExpr(extent.text);
        value = parser_->mu.Eval();
        if (parser_->mu.GetNumResults() != 1) cursor.fail(extent.at, "expected one number, found several");
    } catch (const mu::ParserError& error) {
        cursor.fail(extent.place(offset_of(error, extent.text)),
                    fmt::format("{}; expected an arithmetic expression", message_of(error)));
    }
    check_number(cursor.source(), extent.at, value);
    return value;
}

/// Names that stand for no number get a better message here than muParser has, and assignments none of its favours.
void Expressions::check_words(Cursor& cursor, const Extent& extent) const
{
    const std::string_view text = extent.text;
    for (std::size_t i = 0; i < text.size();) {
        if (const std::size_t length = number_length(text.substr(i)); length > 0) {
            i += length;
            continue;
        }
        if (text[i] == '=') {
            const bool compares = (i > 0 && std::string_view("<>!=").find(text[i - 1]) != std::string_view::npos) ||
                                  (i + 1 < text.size() && text[i + 1] == '=');
            if (!compares) cursor.fail(extent.place(i), "'=' in an expression; constants are defined by 'let'");
        }
        if (!is_word_start(text[i])) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end < text.size() && is_word_part(text[end])) ++end;
        const std::string word(text.substr(i, end - i));
        const auto& functions = parser_->mu.GetFunDef();
        const auto& constants = parser_->mu.GetConst();
        if (vectors_.contains(word)) {
            cursor.fail(extent.place(i), fmt::format("'{}' is a vector; expected a number", word));
        }
        if (!functions.contains(word) && !constants.contains(word)) {
            std::vector<std::string_view> names;
            for (const auto& function : functions) names.emplace_back(function.first);
            for (const auto& constant : constants) names.emplace_back(constant.first);
            cursor.fail(extent.place(i), fmt::format("unknown name '{}'; expected a constant or a function{}", word,
                                                     suggestion(word, names)));
        }
        i = end;
    }
}

bool Expressions::at_vector(Cursor& cursor) const
{
    const std::string_view word = cursor.peek_word();
    return cursor.peek() == '[' || (!word.empty() && vectors_.contains(word));
}

Vec3 Expressions::vector(Cursor& cursor, std::string_view begin, std::string_view and_more)
{
    if (!at_vector(cursor)) {
        const std::string expected = fmt::format("{}{}", begin, and_more);
        const std::string_view word = cursor.peek_word();
        if (word.empty()) cursor.fail_expected(expected);
        if (lines_.contains(word)) {
            cursor.fail(cursor.here(), fmt::format("'{}' is a number; expected {}", word, expected));
        }
        std::vector<std::string_view> names;
        for (const auto& vector : vectors_) names.emplace_back(vector.first);
        cursor.fail(cursor.here(),
                    fmt::format("unknown vector '{}'; expected {}{}", word, expected, suggestion(word, names)));
    }
    if (cursor.peek() != '[') return vectors_.find(cursor.word())->second;
    cursor.open('[', "before a vector");
    Vec3 v;
    v.x = number(cursor);
    cursor.expect(',', "and the second of three numbers");
    v.y = number(cursor);
    cursor.expect(',', "and the third of three numbers");
    v.z = number(cursor);
    cursor.close(']');
    return v;
}

Vec3 Expressions::vector_or_number(Cursor& cursor, std::string_view expected)
{
    if (at_vector(cursor)) return vector(cursor, expected);
    const double value = number(cursor, expected);
    return {value, value, value};
}

} // namespace clucida::scene
