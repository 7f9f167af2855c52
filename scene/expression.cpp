#include "scene/expression.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
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

bool is_time(std::string_view word)
{
    return word == "t" || word == "frames";
}

/// Numbers within 0 and 1 that look random and are the same for the same arguments everywhere (SplitMix64: Steele, Lea
/// and Flood 2014).
double random_of(const double* arguments, int count)
{
    std::uint64_t state = 0x9E3779B97F4A7C15;
    for (int i = 0; i < count; ++i) {
        const double number = arguments[i] + 0.0; // -0 is 0
        state = (state ^ std::bit_cast<std::uint64_t>(number)) + 0x9E3779B97F4A7C15;
        state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9;
        state = (state ^ (state >> 27)) * 0x94D049BB133111EB;
        state ^= state >> 31;
    }
    return static_cast<double>(state >> 11) * 0x1p-53;
}

double smooth_step(double from, double to, double x)
{
    const double s = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

void define_functions(mu::Parser& mu)
{
    using One = mu::fun_type1;
    using Two = mu::fun_type2;
    using Three = mu::fun_type3;
    mu.DefineFun("floor", static_cast<One>([](double x) { return std::floor(x); }));
    mu.DefineFun("ceil", static_cast<One>([](double x) { return std::ceil(x); }));
    mu.DefineFun("radians", static_cast<One>([](double x) { return x * (std::numbers::pi / 180); }));
    mu.DefineFun("degrees", static_cast<One>([](double x) { return x * (180 / std::numbers::pi); }));
    mu.DefineFun("mod", static_cast<Two>([](double x, double y) { return x - y * std::floor(x / y); }));
    mu.DefineFun("clamp",
                 static_cast<Three>([](double x, double lo, double hi) { return std::min(std::max(x, lo), hi); }));
    mu.DefineFun("mix", static_cast<Three>([](double a, double b, double x) { return a + (b - a) * x; }));
    mu.DefineFun("smoothstep", static_cast<Three>(smooth_step));
    mu.DefineFun("random", static_cast<mu::multfun_type>(random_of));
}

} // namespace

Expressions::Expressions(const Moment& moment) : parser_(std::make_unique<Parser>()), moment_(moment)
{
    mu::Parser& mu = parser_->mu;
    mu.DefineConst("pi", std::numbers::pi);
    mu.DefineConst("e", std::numbers::e);
    mu.DefineConst("tau", 2 * std::numbers::pi);
    define_functions(mu);
    mu.DefineConst("frame", moment.frame);
    define_time();
}

Expressions::~Expressions() = default;

/// From 0 in the first frame to 1 in the last; of a loop the first frame comes again where it would be 1.
void Expressions::define_time()
{
    const unsigned frames = moment_.frames > 0 ? moment_.frames : sequence_.frames;
    if (frames == 0) return;
    const double steps = sequence_.loop ? frames : std::max(frames - 1, 1U);
    parser_->mu.DefineConst("t", (static_cast<double>(moment_.frame) - 1) / steps);
    parser_->mu.DefineConst("frames", frames);
}

void Expressions::set_sequence(const Sequence& sequence)
{
    sequence_ = sequence;
    define_time();
}

std::string Expressions::new_name(Cursor& cursor, std::string_view what, Location& at)
{
    cursor.skip_blanks();
    at = cursor.here();
    std::string name(cursor.word());
    if (name.empty()) cursor.fail_expected(fmt::format("a name for the {}", what));
    if (const auto first = lines_.find(name); first != lines_.end()) {
        cursor.fail(at, fmt::format("'{}' is defined in line {} already", name, first->second));
    }
    if (parser_->mu.GetConst().contains(name) || parser_->mu.GetFunDef().contains(name) || is_time(name)) {
        cursor.fail(at, fmt::format("'{}' has a meaning already; expected another name", name));
    }
    cursor.expect('=', "after the {}'s name", what);
    return name;
}

Expressions::Value Expressions::value(Cursor& cursor)
{
    if (at_vector(cursor)) return vector(cursor);
    return number(cursor, "a number or a vector [x, y, z]");
}

void Expressions::keep(const std::string& name, Location at, const Value& value)
{
    if (const auto* v = std::get_if<Vec3>(&value))
        vectors_.emplace(name, *v);
    else
        parser_->mu.DefineConst(name, std::get<double>(value));
    lines_.emplace(name, at.line);
}

void Expressions::define(Cursor& cursor)
{
    Location at;
    const std::string name = new_name(cursor, "constant", at);
    keep(name, at, value(cursor));
}

void Expressions::define_parameter(Cursor& cursor)
{
    Location at;
    const std::string name = new_name(cursor, "parameter", at);
    Value own = value(cursor);
    if (const auto given = moment_.parameters.find(name); given != moment_.parameters.end()) {
        const Value other = given_value(name, given->second);
        if (own.index() != other.index())
            throw Error(fmt::format("--set {}={}: error: expected {}", name, given->second,
                                    own.index() == 0 ? "a number" : "a vector [x, y, z]"));
        own = other;
    }
    keep(name, at, own);
    parameters_.push_back(name);
}

/// A parameter's value as it was given outside of the scene.
Expressions::Value Expressions::given_value(const std::string& name, const std::string& text)
{
    const Source source{fmt::format("--set {}", name), text};
    Cursor cursor(source);
    Value out = value(cursor);
    cursor.skip_blanks();
    if (!cursor.at_end()) cursor.fail_expected("the end of the value");
    return out;
}

void Expressions::check_parameters(const Source& source) const
{
    for (const auto& [name, text] : moment_.parameters) {
        if (std::ranges::find(parameters_, name) != parameters_.end()) continue;
        const std::vector<std::string_view> names(parameters_.begin(), parameters_.end());
        const std::string there = names.empty() ? "none" : listed(names);
        throw Error(fmt::format("{}: error: the scene has no parameter '{}', which --set gives; there is {}{}",
                                source.file, name, there, suggestion(name, names)));
    }
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
void Expressions::check_words(Cursor& cursor, const Extent& extent)
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
        if (word == "t" || word == "frame") usage_.time = true;
        if (is_time(word) && !constants.contains(word)) {
            cursor.fail(extent.place(i), fmt::format("'{}' is not known, for nothing says how many frames there are; "
                                                     "expected 'sequence {{ frames N }}' before",
                                                     word));
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
