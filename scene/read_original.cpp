/// The original program's two texts, gun (2016) and rayt: bare numbers and words, in a fixed order.
#include "scene/limits.h"
#include "scene/pack.h"
#include "scene/read_common.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace clucida::scene {
namespace {

enum class Generation { gun, rayt };

/// Words separated by any white space, with their places.
class Words {
public:
    explicit Words(const Source& source) : source_(source) { skip(); }

    bool at_end() const { return at_ == source_.text.size(); }
    Location here() const { return {line_, at_ - line_start_ + 1}; }
    std::string_view peek() const
    {
        std::size_t end = at_;
        while (end < source_.text.size() && !is_space(source_.text[end])) ++end;
        return source_.text.substr(at_, end - at_);
    }
    void take()
    {
        at_ += peek().size();
        skip();
    }
    [[noreturn]] void fail_expected(std::string_view expected) const
    {
        if (at_end()) source_.fail(here(), fmt::format("expected {}, found the end of the text", expected));
        source_.fail(here(), fmt::format("expected {}, found '{}'", expected, shortened(peek())));
    }
    double number(std::string_view what)
    {
        const Location at = here();
        const std::string_view word = peek();
        const std::optional<double> value = plain_number(word);
        if (!value) fail_expected(fmt::format("a number ({})", what));
        check_number(source_, at, *value);
        take();
        return *value;
    }
    Vec3 vector(std::string_view what)
    {
        Vec3 v;
        v.x = number(what);
        v.y = number(what);
        v.z = number(what);
        return v;
    }
    Rgb color(std::string_view what)
    {
        const Vec3 v = vector(what);
        return {v.x, v.y, v.z};
    }
    std::size_t count(std::string_view what, std::size_t least, std::size_t most)
    {
        std::string_view word = peek();
        if (word.starts_with('+')) word.remove_prefix(1);
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool digits = !word.empty() && end == word.data() + word.size() && error != std::errc::invalid_argument;
        if (!digits || error != std::errc{} || value < least || value > most) {
            fail_expected(fmt::format("{}, a whole number within {} and {}", what, least, most));
        }
        take();
        return value;
    }

private:
    static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
    static std::string_view shortened(std::string_view word) { return word.substr(0, limits::name_length); }
    void skip()
    {
        for (; !at_end() && is_space(source_.text[at_]); ++at_) {
            if (source_.text[at_] != '\n') continue;
            ++line_;
            line_start_ = at_ + 1;
        }
    }

    const Source& source_;
    std::size_t at_ = 0, line_ = 1, line_start_ = 0;
};

const std::vector<std::string_view> gun_solids{"plane", "sphere", "-sphere", "cylinder", "-cylinder", "cone", "-cone"};
const std::vector<std::string_view> rayt_solids{"plane",   "sphere",   "cylinder", "cone",
                                                "parabol", "hyperbol", "saddle",   "cuboid"};

class Reader {
public:
    Reader(const Source& source, PhotographFinder& photographs, Generation generation)
        : source_(source), photographs_(photographs), generation_(generation), words_(source)
    {
    }

    Scene read();

private:
    bool gun() const { return generation_ == Generation::gun; }
    std::size_t header();
    void check_totals() const;
    void observer();
    void object();
    SolidPtr solid();
    SolidPtr member(std::string_view expected);
    decltype(Solid::node) primitive(std::string_view word, std::vector<Location>& places);
    std::size_t optics();
    std::optional<std::size_t> decoration();
    void sky();
    void lights();
    Photograph photograph();

    Vec3 vector(std::string_view what, std::vector<Location>& places)
    {
        places.push_back(words_.here());
        return words_.vector(what);
    }
    double number(std::string_view what, std::vector<Location>& places)
    {
        places.push_back(words_.here());
        return words_.number(what);
    }
    Rgb filter(std::string_view what)
    {
        const Location at = words_.here();
        const Rgb color = words_.color(what);
        check_filter(source_, at, color, what);
        return color;
    }
    Rgb light(std::string_view what)
    {
        const Location at = words_.here();
        const Rgb color = words_.color(what);
        check_light(source_, at, color, what);
        return color;
    }

    const Source& source_;
    PhotographFinder& photographs_;
    Generation generation_;
    Words words_;
    Scene scene_;
    std::map<std::array<double, 13>, std::size_t> optics_;
    std::map<std::pair<std::string, std::array<double, 15>>, std::size_t> textures_;
    /// What the gun's header says, where it says so, and what the objects add up to.
    std::size_t intersections_ = 0, members_ = 0, counted_intersections_ = 0, counted_members_ = 0;
    Location intersections_at_, members_at_;
};

Scene Reader::read()
{
    if (!gun()) scene_.settings.media_rule = MediaRule::rank;
    observer();
    const std::size_t objects = header();
    // The count is no promise: memory is taken as objects come.
    while (scene_.objects.size() < objects) object();
    if (gun()) check_totals();
    sky();
    lights();
    if (!words_.at_end()) words_.fail_expected("nothing after the lights");
    return std::move(scene_);
}

std::size_t Reader::header()
{
    const Location at = words_.here();
    const std::size_t objects = words_.count("the number of objects", gun() ? 1 : 0, limits::objects);
    if (!gun()) return objects;
    intersections_at_ = words_.here();
    intersections_ = words_.count("the number of intersections", 0, limits::objects);
    if (intersections_ > objects) {
        source_.fail(at, fmt::format("{} objects cannot be {} intersections; expected as many objects or more", objects,
                                     intersections_));
    }
    members_at_ = words_.here();
    members_ = words_.count("the number of members of all intersections", 0, limits::objects * limits::members);
    return objects;
}

void Reader::check_totals() const
{
    if (counted_intersections_ != intersections_) {
        source_.fail(intersections_at_, fmt::format("the objects have {} intersections; expected {} as announced here",
                                                    counted_intersections_, intersections_));
    }
    if (counted_members_ != members_) {
        source_.fail(members_at_, fmt::format("the intersections have {} members; expected {} as announced here",
                                              counted_members_, members_));
    }
}

void Reader::observer()
{
    Window o;
    std::vector<Location> at;
    o.eye = vector("the eye", at);
    o.view = vector("the point of view", at);
    o.column = vector("the column", at);
    if (gun()) {
        o.row = vector("the row", at);
    } else {
        at.push_back(at.back());
        const Vec3 e = o.view - o.eye;
        const double side = length(o.column);
        if (e != Vec3{} && side > 0) {
            if (parallel(o.column, e))
                source_.fail(at[2], "the column is parallel to the view; expected it to stand off");
            const Vec3 across = cross(o.column, e);
            o.row = (side / length(across)) * across;
            const Vec3 along = cross(e, o.row);
            o.column = (side / length(along)) * along;
            for (double* x : {&o.column.x, &o.column.y, &o.column.z, &o.row.x, &o.row.y, &o.row.z}) {
                if (std::abs(*x) < limits::smallest) *x = 0; // computed, and less than a text may say
                check_number(source_, at[2], *x);
            }
        }
    }
    check(source_, fault_of(o), at);
    scene_.observer = o;
}

void Reader::object()
{
    Object o;
    o.at = words_.here();
    o.solid = solid();
    if (gun()) {
        o.texture = decoration();
    } else {
        if (words_.peek() != "optics") words_.fail_expected("'optics'");
        words_.take();
    }
    o.optics = optics();
    scene_.objects.push_back(std::move(o));
}

SolidPtr Reader::solid()
{
    const std::string expected = gun() ? listed(gun_solids) + " or x"
                                       : fmt::format("{}, one of them with '-' before it, or x", listed(rayt_solids));
    const Location at = words_.here();
    if (words_.peek() != "x") return member(expected);
    words_.take();
    const std::size_t count = words_.count("the number of members of the intersection", 1, limits::members);
    ++counted_intersections_;
    counted_members_ += count;
    std::vector<SolidPtr> members;
    while (members.size() < count) members.push_back(member(fmt::format("a member of the intersection: {}", expected)));
    if (count == 1) return members.front();
    return make_solid(Intersection{std::move(members)}, at);
}

SolidPtr Reader::member(std::string_view expected)
{
    const Location at = words_.here();
    const std::string_view word = words_.peek();
    const bool inverse = word.starts_with('-');
    const std::string_view kind = word.substr(inverse ? 1 : 0);
    const auto& known = gun() ? gun_solids : rayt_solids;
    if (std::find(known.begin(), known.end(), gun() ? word : kind) == known.end()) words_.fail_expected(expected);
    words_.take();
    std::vector<Location> places;
    auto node = primitive(kind, places);
    check(source_, fault_of(node), places);
    if (kind == "cuboid") {
        // Read as reciprocal half sizes of any sign; the model has full sizes, and 0 for unbounded there as well.
        Vec3& s = std::get<Cuboid>(node).size;
        const auto full = [](double reciprocal) { return reciprocal == 0 ? 0 : 2 / reciprocal; };
        s = {full(s.x), full(s.y), full(s.z)};
        for (const double size : {s.x, s.y, s.z}) check_number(source_, places[3], size);
    }
    SolidPtr solid = make_solid(std::move(node), at);
    // parabol is the side away from the focus.
    if (inverse != (kind == "parabol")) return make_solid(Complement{std::move(solid)}, at);
    return solid;
}

decltype(Solid::node) Reader::primitive(std::string_view word, std::vector<Location>& at)
{
    if (word == "plane") return Plane{vector("a point", at), vector("the normal", at)};
    if (word == "sphere") return Sphere{vector("the center", at), number("the radius", at)};
    if (word == "cylinder") return Cylinder{vector("a point", at), vector("the axis", at)};
    if (word == "cone") return Cone{vector("the apex", at), vector("the axis", at)};
    if (word == "parabol") return Paraboloid{vector("the vertex", at), vector("the focus", at)};
    if (word == "hyperbol") {
        return Hyperboloid{vector("the center", at), vector("the axis", at), number("the waist", at)};
    }
    if (word == "saddle")
        return Saddle{vector("the center", at), vector("the axis", at), vector("the x direction", at)};
    Cuboid cuboid{vector("the center", at), vector("the z axis", at), vector("the x axis", at),
                  vector("the reciprocal half sizes", at)};
    Vec3& s = cuboid.size;
    s = {std::abs(s.x), std::abs(s.y), std::abs(s.z)};
    return cuboid;
}

/// rayt keeps filters as bytes, and decodes those as sRGB when they are emitted.
Rgb as_emitted(Rgb c)
{
    const auto channel = [](double v) { return srgb_decode(rounded_to_byte(v)); };
    return {channel(c.r), channel(c.g), channel(c.b)};
}

std::size_t Reader::optics()
{
    Optics o;
    o.at = words_.here();
    o.reflection = filter("the reflection");
    o.absorption = filter("the absorption");
    o.index = words_.number("the index of refraction");
    if (gun()) o.index = std::max(o.index, 0.0); // the author's own texts write -1 for opaque
    o.refraction = filter("the refraction");
    if (o.index < 0) o.refraction = as_emitted(o.refraction);
    o.passthrough = filter("the passthrough");
    const std::array<double, 13> key{o.reflection.r,  o.reflection.g,  o.reflection.b, o.absorption.r, o.absorption.g,
                                     o.absorption.b,  o.index,         o.refraction.r, o.refraction.g, o.refraction.b,
                                     o.passthrough.r, o.passthrough.g, o.passthrough.b};
    const auto [known, added] = optics_.emplace(key, scene_.optics.size());
    if (added) {
        o.name = fmt::format("optics_{}", scene_.optics.size() + 1);
        scene_.optics.push_back(std::move(o));
    }
    return known->second;
}

Photograph Reader::photograph()
{
    Photograph p;
    p.at = words_.here();
    if (words_.at_end()) words_.fail_expected("the path of a photograph");
    p.path = std::string(words_.peek());
    p.file = photographs_.find(p.path, p.at);
    p.linear = gun();
    p.interpolate = false;
    words_.take();
    return p;
}

std::optional<std::size_t> Reader::decoration()
{
    const std::string_view kind = words_.peek();
    if (kind.empty() || !((kind[0] >= 'a' && kind[0] <= 'z') || (kind[0] >= 'A' && kind[0] <= 'Z'))) return {};
    if (kind != "directional" && kind != "positional" && kind != "relative" && kind != "linear") {
        words_.fail_expected("directional, positional, relative, linear or the reflection, a number");
    }
    Texture t;
    t.at = words_.here();
    words_.take();
    std::vector<Location> places;
    const Vec3 n = vector("n", places);
    const Vec3 origin = kind == "relative" || kind == "linear" ? vector("the origin", places) : Vec3{};
    if (kind == "directional") t.mapping = Directional{n};
    if (kind == "positional") t.mapping = Positional{n};
    if (kind == "relative") t.mapping = Relative{n, origin};
    if (kind == "linear") t.mapping = Linear{n, origin};
    check(source_, fault_of(t.mapping), places);
    t.photograph = photograph();
    t.wrap_x = words_.number("x_wrap");
    t.wrap_y = words_.number("y_wrap");
    t.reflection = light("the photograph's share in reflection");
    t.absorption = light("the photograph's share in absorption");
    light("the photograph's share in refraction"); // has no effect in the original
    const std::array<double, 15> values{static_cast<double>(t.mapping.index()),
                                        n.x,
                                        n.y,
                                        n.z,
                                        origin.x,
                                        origin.y,
                                        origin.z,
                                        t.wrap_x,
                                        t.wrap_y,
                                        t.reflection.r,
                                        t.reflection.g,
                                        t.reflection.b,
                                        t.absorption.r,
                                        t.absorption.g,
                                        t.absorption.b};
    const auto [known, added] = textures_.emplace(std::pair(t.photograph.path, values), scene_.textures.size());
    if (added) {
        check_room(source_, t.at, scene_.textures.size(), limits::textures, "textures");
        t.name = fmt::format("texture_{}", scene_.textures.size() + 1);
        scene_.textures.push_back(std::move(t));
    }
    return known->second;
}

void Reader::sky()
{
    const std::string_view word = words_.peek();
    if (word.empty()) {
        words_.fail_expected(gun() ? "the sky: rgb, color or a photograph" : "the sky: rgb, hsv or a photograph");
    }
    if (word == "rgb") {
        scene_.sky = SkyRgb{};
        words_.take();
    } else if (word == "hsv" && !gun()) {
        scene_.sky = SkyHsv{};
        words_.take();
    } else if (word == "color" && gun()) {
        words_.take();
        scene_.sky = SkyColor{light("the sky's color")};
    } else {
        scene_.sky = SkyPhotograph{photograph()};
    }
}

void Reader::lights()
{
    const std::size_t count = words_.count("the number of lights", 0, limits::lights);
    while (scene_.lights.size() < count) {
        Light l;
        l.at = words_.here();
        l.point = words_.vector("the light's point");
        l.color = light("the light's color");
        scene_.lights.push_back(l);
    }
}

} // namespace

Scene read_gun(const Source& source, PhotographFinder& photographs)
{
    return Reader(source, photographs, Generation::gun).read();
}

Scene read_rayt(const Source& source, PhotographFinder& photographs)
{
    return Reader(source, photographs, Generation::rayt).read();
}

} // namespace clucida::scene
