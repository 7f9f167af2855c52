/// clucida's own language, version 1: docs/scene-language.md. One statement a line or a braced block.
#include "scene/expression.h"
#include "scene/lexer.h"
#include "scene/limits.h"
#include "scene/read_common.h"
#include "scene/read_solid.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace clucida::scene {
namespace {

Rgb as_color(const Vec3& v)
{
    return {v.x, v.y, v.z};
}

/// What may stand in a block: `word VALUE`, once.
struct Entry {
    std::string_view word;
    std::function<void()> read;
    bool required = false;
};

/// Names of one kind and where they were defined.
struct Names {
    std::string_view kind;
    struct Item {
        std::size_t index, line;
    };
    std::map<std::string, Item, std::less<>> items{};
};

class Reader {
public:
    Reader(const Source& source, PhotographFinder& photographs, const Moment& moment)
        : source_(source), photographs_(photographs), cursor_(source), expressions_(moment),
          solids_(cursor_, expressions_)
    {
    }

    Scene read();
    const Usage& usage() const { return expressions_.usage(); }

private:
    void version();
    void statement(std::string_view word, Location at);
    void once(std::size_t& line, Location at, std::string_view what) const;

    void block(std::string_view of, const std::vector<Entry>& entries);
    std::string name(Names& names, std::size_t index);
    std::size_t reference(const Names& names);
    std::string_view choice(const std::vector<std::string_view>& words);

    Vec3 vector(Location& at);
    Rgb color(Location& at);
    Entry filter(std::string_view word, Rgb& color);
    Entry light_color(std::string_view word, Rgb& color, bool required);
    Entry photograph_encoding(Photograph& photograph);
    Entry photograph_filter(Photograph& photograph);
    void photograph(Photograph& photograph);

    void settings();
    void sequence();
    void observer();
    void pinhole();
    void window();
    void sky();
    void light(Location at);
    void object(Location at);
    void define_optics(Location at);
    void define_texture(Location at);
    std::size_t optics_block(std::string name, Location at);
    std::size_t texture_block(std::string name, Location at);
    void mapping(Texture& texture);

    const Source& source_;
    PhotographFinder& photographs_;
    Cursor cursor_;
    Expressions expressions_;
    SolidReader solids_;
    Scene scene_;
    Names optics_{"optics"}, textures_{"texture"}, objects_{"object"};
    std::size_t settings_line_ = 0, sequence_line_ = 0, observer_line_ = 0, sky_line_ = 0;
};

const std::vector<std::string_view> statements{"let",   "parameter", "settings", "sequence", "observer", "sky",
                                               "light", "solid",     "optics",   "texture",  "object"};

Scene Reader::read()
{
    version();
    while (true) {
        cursor_.skip_separators();
        if (cursor_.at_end()) break;
        const Location at = cursor_.here();
        const std::string_view word = cursor_.word();
        if (word.empty()) cursor_.fail_expected(fmt::format("a statement: {}", listed(statements)));
        statement(word, at);
        cursor_.end_statement();
    }
    if (observer_line_ == 0) cursor_.fail_expected("an observer: the scene has none");
    expressions_.check_parameters(source_);
    return std::move(scene_);
}

void Reader::version()
{
    cursor_.skip_separators();
    if (cursor_.peek_word() != "clucida") cursor_.fail_expected("'clucida 1', the language's version");
    cursor_.word();
    cursor_.skip_blanks();
    const Location at = cursor_.here();
    const double version = expressions_.number(cursor_, "the language's version, 1");
    if (version != 1) source_.fail(at, fmt::format("version {} of the language is not known; expected 1", version));
    cursor_.end_statement();
}

void Reader::statement(std::string_view word, Location at)
{
    if (word == "let") return expressions_.define(cursor_);
    if (word == "parameter") return expressions_.define_parameter(cursor_);
    if (word == "solid") return solids_.define();
    if (word == "optics") return define_optics(at);
    if (word == "texture") return define_texture(at);
    if (word == "object") return object(at);
    if (word == "light") return light(at);
    if (word == "settings") {
        once(settings_line_, at, "the settings");
        return settings();
    }
    if (word == "sequence") {
        once(sequence_line_, at, "the sequence");
        return sequence();
    }
    if (word == "observer") {
        once(observer_line_, at, "the observer");
        return observer();
    }
    if (word == "sky") {
        once(sky_line_, at, "the sky");
        return sky();
    }
    if (word == "clucida") source_.fail(at, "the language's version is given in the first statement only");
    source_.fail(at, fmt::format("unknown statement '{}'; expected {}{}", word, listed(statements),
                                 suggestion(word, statements)));
}

void Reader::once(std::size_t& line, Location at, std::string_view what) const
{
    if (line != 0) source_.fail(at, fmt::format("{} stand in line {} already; expected them once", what, line));
    line = at.line;
}

void Reader::block(std::string_view of, const std::vector<Entry>& entries)
{
    std::vector<std::size_t> lines(entries.size(), 0);
    std::vector<std::string_view> words;
    words.reserve(entries.size());
    for (const Entry& entry : entries) words.push_back(entry.word);
    cursor_.open('{', "before the entries of {}", of);
    while (true) {
        cursor_.skip_separators();
        const Location at = cursor_.here();
        if (cursor_.accept_close('}')) {
            for (std::size_t i = 0; i < entries.size(); ++i) {
                if (!entries[i].required || lines[i] != 0) continue;
                source_.fail(at, fmt::format("expected '{}' before the end of {}", entries[i].word, of));
            }
            return;
        }
        const std::string_view word = cursor_.word();
        if (word.empty()) cursor_.fail_expected(fmt::format("{} or '}}'", listed(words)));
        std::size_t i = 0;
        while (i < entries.size() && entries[i].word != word) ++i;
        if (i == entries.size()) {
            source_.fail(at, fmt::format("unknown word '{}' in {}; expected {}{}", word, of, listed(words),
                                         suggestion(word, words)));
        }
        if (lines[i] != 0) source_.fail(at, fmt::format("'{}' stands in line {} already", word, lines[i]));
        lines[i] = at.line;
        entries[i].read();
        cursor_.end_statement();
    }
}

/// A new name at the cursor for the thing of that index.
std::string Reader::name(Names& names, std::size_t index)
{
    cursor_.skip_blanks();
    const Location at = cursor_.here();
    std::string name(cursor_.word());
    if (name.empty()) cursor_.fail_expected(fmt::format("a name for the {}", names.kind));
    const auto [item, added] = names.items.emplace(name, Names::Item{index, at.line});
    if (!added) {
        source_.fail(at, fmt::format("{} '{}' is defined in line {} already", names.kind, name, item->second.line));
    }
    return name;
}

std::size_t Reader::reference(const Names& names)
{
    cursor_.skip_blanks();
    const Location at = cursor_.here();
    const std::string_view word = cursor_.word();
    if (word.empty()) cursor_.fail_expected(fmt::format("the name of {} or '{{'", names.kind));
    if (const auto found = names.items.find(word); found != names.items.end()) return found->second.index;
    std::vector<std::string_view> known;
    for (const auto& item : names.items) known.emplace_back(item.first);
    source_.fail(at, fmt::format("unknown {} '{}'; expected a name defined above or '{{'{}", names.kind, word,
                                 suggestion(word, known)));
}

std::string_view Reader::choice(const std::vector<std::string_view>& words)
{
    cursor_.skip_blanks();
    const Location at = cursor_.here();
    const std::string_view word = cursor_.word();
    if (word.empty()) cursor_.fail_expected(listed(words));
    for (const std::string_view known : words) {
        if (word == known) return known;
    }
    source_.fail(at, fmt::format("unknown word '{}'; expected {}{}", word, listed(words), suggestion(word, words)));
}

Vec3 Reader::vector(Location& at)
{
    cursor_.skip_blanks();
    at = cursor_.here();
    return expressions_.vector(cursor_);
}

Rgb Reader::color(Location& at)
{
    cursor_.skip_blanks();
    at = cursor_.here();
    return as_color(expressions_.vector_or_number(cursor_, "a color, [red, green, blue] or one number"));
}

Entry Reader::filter(std::string_view word, Rgb& value)
{
    return {word, [this, word, &value] {
                Location at;
                value = color(at);
                check_filter(source_, at, value, word);
            }};
}

Entry Reader::light_color(std::string_view word, Rgb& value, bool required)
{
    return {word,
            [this, word, &value] {
                Location at;
                value = color(at);
                check_light(source_, at, value, word);
            },
            required};
}

Entry Reader::photograph_encoding(Photograph& photograph)
{
    return {"encoding", [this, &photograph] { photograph.linear = choice({"srgb", "linear"}) == "linear"; }};
}

Entry Reader::photograph_filter(Photograph& photograph)
{
    return {"filter", [this, &photograph] { photograph.interpolate = choice({"nearest", "bilinear"}) == "bilinear"; }};
}

void Reader::photograph(Photograph& photograph)
{
    cursor_.skip_blanks();
    photograph.at = cursor_.here();
    photograph.path = cursor_.string("the path of a photograph in double quotes");
    photograph.file = photographs_.find(photograph.path, photograph.at);
}

void Reader::settings()
{
    Settings& s = scene_.settings;
    const auto hops = [&] {
        cursor_.skip_blanks();
        const Location at = cursor_.here();
        const double value = expressions_.number(cursor_);
        if (!(value >= 1 && value <= limits::hops) || value != std::floor(value)) {
            source_.fail(at, fmt::format("expected a whole number of hops within 1 and {}", limits::hops));
        }
        s.max_hops = static_cast<unsigned>(value);
    };
    const auto cutoff = [&] {
        cursor_.skip_blanks();
        const Location at = cursor_.here();
        s.cutoff = expressions_.number(cursor_);
        if (!(s.cutoff >= 0 && s.cutoff <= 1)) source_.fail(at, "expected a cutoff within 0 and 1");
    };
    const auto light_law = [&] {
        const std::string_view word = choice({"paper", "lambert", "inverse_square"});
        s.light_law = word == "paper"     ? LightLaw::paper
                      : word == "lambert" ? LightLaw::lambert
                                          : LightLaw::inverse_square;
    };
    const auto media = [&] {
        s.media_rule = choice({"nearest", "rank"}) == "rank" ? MediaRule::rank : MediaRule::nearest;
    };
    block("the settings", {{"hops", hops}, {"cutoff", cutoff}, {"light_law", light_law}, {"media", media}});
}

void Reader::sequence()
{
    Sequence& s = scene_.sequence;
    const auto frames = [&] {
        cursor_.skip_blanks();
        const Location at = cursor_.here();
        const double value = expressions_.number(cursor_);
        if (!(value >= 1 && value <= limits::frames) || value != std::floor(value)) {
            source_.fail(at, fmt::format("expected a whole number of frames within 1 and {}", limits::frames));
        }
        s.frames = static_cast<unsigned>(value);
    };
    const auto fps = [&] {
        cursor_.skip_blanks();
        const Location at = cursor_.here();
        s.fps = expressions_.number(cursor_);
        if (!(s.fps > 0 && s.fps <= 1000)) source_.fail(at, "expected frames per second above 0, and 1000 at most");
    };
    block("the sequence", {{"frames", frames}, {"fps", fps}, {"loop", [&] { s.loop = true; }}});
    expressions_.set_sequence(s);
}

void Reader::observer()
{
    if (const std::string_view word = cursor_.peek_word(); word.empty()) return pinhole();
    choice({"window"});
    window();
}

void Reader::pinhole()
{
    Pinhole o;
    cursor_.skip_blanks();
    std::vector<Location> at(4, cursor_.here());
    const auto fov = [&] {
        cursor_.skip_blanks();
        at[3] = cursor_.here();
        o.fov = expressions_.number(cursor_);
    };
    block("the observer", {{"eye", [&] { o.eye = vector(at[0]); }, true},
                           {"look", [&] { o.look = vector(at[1]); }, true},
                           {"up", [&] { o.up = vector(at[2]); }},
                           {"fov", fov}});
    check(source_, fault_of(o), at);
    scene_.observer = o;
}

void Reader::window()
{
    Window o;
    std::vector<Location> at(4);
    block("the observer", {{"eye", [&] { o.eye = vector(at[0]); }, true},
                           {"view", [&] { o.view = vector(at[1]); }, true},
                           {"column", [&] { o.column = vector(at[2]); }, true},
                           {"row", [&] { o.row = vector(at[3]); }, true}});
    check(source_, fault_of(o), at);
    scene_.observer = o;
}

void Reader::sky()
{
    Location at;
    const std::string_view kind = choice({"color", "gradient", "rgb", "hsv", "photograph"});
    if (kind == "color") {
        const Rgb value = color(at);
        check_light(source_, at, value, "the color");
        scene_.sky = SkyColor{value};
    } else if (kind == "gradient") {
        SkyGradient g;
        block("the gradient", {light_color("low", g.low, true),
                               light_color("middle", g.middle, true),
                               light_color("high", g.high, true),
                               {"up", [&] { g.up = vector(at); }}});
        if (g.up == Vec3{}) source_.fail(at, "up is 0; expected a vector of some length");
        scene_.sky = g;
    } else if (kind == "photograph") {
        SkyPhotograph s;
        photograph(s.photograph);
        cursor_.skip_blanks();
        if (cursor_.peek() == '{') {
            block("the photograph", {photograph_encoding(s.photograph), photograph_filter(s.photograph)});
        }
        scene_.sky = s;
    } else if (kind == "rgb") {
        scene_.sky = SkyRgb{};
    } else {
        scene_.sky = SkyHsv{};
    }
}

void Reader::light(Location at)
{
    check_room(source_, at, scene_.lights.size(), limits::lights, "lights");
    Light light;
    light.at = at;
    Location place;
    block("the light",
          {{"point", [&] { light.point = vector(place); }, true}, light_color("color", light.color, false)});
    scene_.lights.push_back(light);
}

void Reader::define_optics(Location at)
{
    std::string defined = name(optics_, scene_.optics.size());
    optics_block(std::move(defined), at);
}

std::size_t Reader::optics_block(std::string name, Location at)
{
    Optics o;
    o.name = std::move(name);
    o.at = at;
    const auto index = [&] { o.index = expressions_.number(cursor_); };
    block("the optics", {filter("reflection", o.reflection),
                         filter("absorption", o.absorption),
                         {"index", index},
                         filter("refraction", o.refraction),
                         filter("passthrough", o.passthrough),
                         {"fresnel", [&] { o.fresnel = true; }}});
    scene_.optics.push_back(std::move(o));
    return scene_.optics.size() - 1;
}

void Reader::define_texture(Location at)
{
    std::string defined = name(textures_, scene_.textures.size());
    texture_block(std::move(defined), at);
}

std::size_t Reader::texture_block(std::string name, Location at)
{
    check_room(source_, at, scene_.textures.size(), limits::textures, "textures");
    Texture t;
    t.name = std::move(name);
    t.at = at;
    const auto wrap = [&] {
        cursor_.open('[', "before the two numbers of wrap");
        t.wrap_x = expressions_.number(cursor_);
        cursor_.expect(',', "and the second of two numbers");
        t.wrap_y = expressions_.number(cursor_);
        cursor_.close(']');
    };
    block("the texture", {{"photograph", [&] { photograph(t.photograph); }, true},
                          photograph_encoding(t.photograph),
                          photograph_filter(t.photograph),
                          {"mapping", [&] { mapping(t); }, true},
                          {"wrap", wrap},
                          light_color("reflection", t.reflection, false),
                          light_color("absorption", t.absorption, false),
                          light_color("refraction", t.refraction, false)});
    scene_.textures.push_back(std::move(t));
    return scene_.textures.size() - 1;
}

void Reader::mapping(Texture& texture)
{
    const std::string_view kind = choice({"directional", "positional", "relative", "linear", "planar"});
    std::vector<Location> at(3);
    if (kind == "planar") {
        Planar m;
        block("the mapping", {{"origin", [&] { m.origin = vector(at[0]); }, true},
                              {"u", [&] { m.u = vector(at[1]); }, true},
                              {"v", [&] { m.v = vector(at[2]); }, true}});
        texture.mapping = m;
    } else {
        Vec3 n;
        Vec3 origin;
        std::vector<Entry> entries{{"n", [&] { n = vector(at[0]); }, true}};
        const bool about = kind == "relative" || kind == "linear";
        if (about) entries.push_back({"origin", [&] { origin = vector(at[1]); }, true});
        block("the mapping", entries);
        if (kind == "directional") texture.mapping = Directional{n};
        if (kind == "positional") texture.mapping = Positional{n};
        if (kind == "relative") texture.mapping = Relative{n, origin};
        if (kind == "linear") texture.mapping = Linear{n, origin};
    }
    check(source_, fault_of(texture.mapping), at);
}

void Reader::object(Location at)
{
    check_room(source_, at, scene_.objects.size(), limits::objects, "objects");
    Object o;
    o.at = at;
    if (!cursor_.peek_word().empty()) o.name = name(objects_, scene_.objects.size());
    const auto braced = [&] {
        cursor_.skip_blanks();
        return cursor_.peek() == '{';
    };
    const auto optics = [&] { o.optics = braced() ? optics_block("", cursor_.here()) : reference(optics_); };
    const auto texture = [&] { o.texture = braced() ? texture_block("", cursor_.here()) : reference(textures_); };
    block("the object",
          {{"solid", [&] { o.solid = solids_.read(); }, true}, {"optics", optics, true}, {"texture", texture}});
    scene_.objects.push_back(std::move(o));
}

} // namespace

Scene read_clucida(const Source& source, PhotographFinder& photographs, const Moment& moment, Usage& usage)
{
    Reader reader(source, photographs, moment);
    Scene scene = reader.read();
    usage = reader.usage();
    return scene;
}

} // namespace clucida::scene
