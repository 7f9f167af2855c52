#include "scene/write.h"

#include "scene/lexer.h"
#include "scene/limits.h"
#include "scene/read_solid.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>
#include <type_traits>
#include <unordered_map>

namespace clucida::scene {
namespace {

std::string print(double x)
{
    return fmt::format("{}", x);
} // the shortest that reads back the same
std::string print(const Vec3& v)
{
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
std::string print(const Rgb& c)
{
    return c.r == c.g && c.g == c.b ? print(c.r) : fmt::format("[{}, {}, {}]", c.r, c.g, c.b);
}

std::string quoted(const std::string& text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

bool is_name(const std::string& name)
{
    return !name.empty() && name.size() <= limits::name_length && is_word_start(name[0]) &&
           std::all_of(name.begin(), name.end(), is_word_part);
}

/// Names of one kind, each given once.
class Names {
public:
    explicit Names(std::string_view kind) : kind_(kind) {}
    void reserve(const std::string& name) { taken_.insert(name); }
    /// The wanted name if it is a good one and free, else one made up.
    std::string give(const std::string& wanted)
    {
        if (is_name(wanted) && taken_.insert(wanted).second) return wanted;
        std::string made;
        do made = fmt::format("{}_{}", kind_, ++count_);
        while (!taken_.insert(made).second);
        return made;
    }

private:
    std::string kind_;
    std::set<std::string> taken_;
    std::size_t count_ = 0;
};

/// The entries of a block: `{ a 1; b 2 }`.
class Block {
public:
    Block& add(std::string_view word, std::string_view value)
    {
        if (!text_.empty()) text_ += "; ";
        text_ += word;
        if (!value.empty()) text_ += ' ';
        text_ += value;
        return *this;
    }
    template <typename T>
    Block& add_unless(const T& standard, std::string_view word, const T& value)
    {
        return value == standard ? *this : add(word, print(value));
    }
    std::string text() const { return text_.empty() ? "{ }" : fmt::format("{{ {} }}", text_); }

private:
    std::string text_;
};

/// How strongly an expression binds, from the weakest.
enum class Level { any_of, difference, all_of, unary };

struct Expression {
    std::string text;
    Level level = Level::unary;
};

std::string at_least(Level level, const Expression& e)
{
    return e.level < level ? fmt::format("({})", e.text) : e.text;
}

class SolidWriter {
public:
    explicit SolidWriter(const Scene& scene);
    /// The solid as an expression; definitions that it needs are appended to out.
    std::string use(const Solid& solid, std::string& out) { return expression(solid, out).text; }

private:
    void count(const Solid& solid);
    Expression expression(const Solid& solid, std::string& out);
    Expression spelled(const Solid& solid, std::string& out);
    Expression list(const std::vector<SolidPtr>& of, std::string_view sign, Level level, std::string& out);
    Expression transformed(const Transformed& t, std::string& out);

    Names names_{"solid"};
    std::unordered_map<const Solid*, std::size_t> uses_;
    std::unordered_map<const Solid*, std::string> defined_;
};

/// Calls f for each solid that this one is directly made of.
template <typename F>
void for_parts(const Solid& solid, const F& f)
{
    std::visit(
        [&](const auto& node) {
            using Node = std::decay_t<decltype(node)>;
            if constexpr (std::is_same_v<Node, Complement> || std::is_same_v<Node, Transformed>) f(*node.of);
            if constexpr (std::is_same_v<Node, Intersection> || std::is_same_v<Node, Union>) {
                for (const SolidPtr& part : node.of) f(*part);
            }
            if constexpr (std::is_same_v<Node, Difference>) {
                f(*node.from);
                f(*node.take);
            }
        },
        solid.node);
}

SolidWriter::SolidWriter(const Scene& scene)
{
    for (const std::string_view word : SolidReader::reserved()) names_.reserve(std::string(word));
    for (const Object& object : scene.objects) count(*object.solid);
}

void SolidWriter::count(const Solid& solid)
{
    if (++uses_[&solid] > 1) return;
    for_parts(solid, [this](const Solid& part) { count(part); });
}

Expression SolidWriter::expression(const Solid& solid, std::string& out)
{
    if (const auto known = defined_.find(&solid); known != defined_.end()) return {known->second};
    bool composite = false;
    for_parts(solid, [&](const Solid&) { composite = true; });
    // Shared nodes get a name even if they had none: written out at each use, a text could grow exponentially.
    const bool shared = composite && uses_[&solid] > 1;
    Expression spelled_out = spelled(solid, out);
    if (solid.name.empty() && !shared) return spelled_out;
    std::string name = names_.give(solid.name);
    fmt::format_to(std::back_inserter(out), "solid {} = {}\n", name, spelled_out.text);
    defined_.emplace(&solid, name);
    return {std::move(name)};
}

Expression SolidWriter::list(const std::vector<SolidPtr>& of, std::string_view sign, Level level, std::string& out)
{
    const auto above = static_cast<Level>(static_cast<int>(level) + 1);
    Expression all{"", level};
    for (const SolidPtr& part : of) {
        if (!all.text.empty()) all.text += sign;
        all.text += at_least(above, expression(*part, out));
    }
    return all;
}

Expression SolidWriter::transformed(const Transformed& t, std::string& out)
{
    const std::string of = expression(*t.of, out).text;
    if (const auto* move = std::get_if<Move>(&t.by)) return {fmt::format("move({}, {})", print(move->by), of)};
    if (const auto* rotate = std::get_if<Rotate>(&t.by)) {
        return {fmt::format("rotate({}, {}, {})", print(rotate->axis), print(rotate->degrees), of)};
    }
    const Vec3 by = std::get<Scale>(t.by).by;
    return {fmt::format("scale({}, {})", print(Rgb{by.x, by.y, by.z}), of)};
}

Expression SolidWriter::spelled(const Solid& solid, std::string& out)
{
    return std::visit(
        [&](const auto& n) -> Expression {
            using Node = std::decay_t<decltype(n)>;
            if constexpr (std::is_same_v<Node, Plane>) {
                return {fmt::format("plane({}, {})", print(n.point), print(n.normal))};
            } else if constexpr (std::is_same_v<Node, Sphere>) {
                return {fmt::format("sphere({}, {})", print(n.center), print(n.radius))};
            } else if constexpr (std::is_same_v<Node, Cylinder>) {
                return {fmt::format("cylinder({}, {})", print(n.point), print(n.axis))};
            } else if constexpr (std::is_same_v<Node, Cone>) {
                return {fmt::format("cone({}, {})", print(n.apex), print(n.axis))};
            } else if constexpr (std::is_same_v<Node, Paraboloid>) {
                return {fmt::format("paraboloid({}, {})", print(n.vertex), print(n.focus))};
            } else if constexpr (std::is_same_v<Node, Hyperboloid>) {
                return {fmt::format("hyperboloid({}, {}, {})", print(n.center), print(n.axis), print(n.waist))};
            } else if constexpr (std::is_same_v<Node, Saddle>) {
                return {fmt::format("saddle({}, {}, {})", print(n.center), print(n.axis), print(n.x))};
            } else if constexpr (std::is_same_v<Node, Cuboid>) {
                if (n.z == Vec3{0, 0, 1} && n.x == Vec3{1, 0, 0}) {
                    return {fmt::format("cuboid({}, {})", print(n.center), print(n.size))};
                }
                return {fmt::format("cuboid({}, {}, {}, {})", print(n.center), print(n.z), print(n.x), print(n.size))};
            } else if constexpr (std::is_same_v<Node, Torus>) {
                return {fmt::format("torus({}, {}, {}, {})", print(n.center), print(n.axis), n.major, n.minor)};
            } else if constexpr (std::is_same_v<Node, FreeQuadric>) {
                const auto three = [&](std::size_t i) { return print(Vec3{n.q[i], n.q[i + 1], n.q[i + 2]}); };
                return {fmt::format("quadric({}, {}, {}, {})", three(0), three(3), three(6), n.q[9])};
            } else if constexpr (std::is_same_v<Node, Complement>) {
                return {fmt::format("!{}", at_least(Level::unary, expression(*n.of, out)))};
            } else if constexpr (std::is_same_v<Node, Intersection>) {
                return list(n.of, " & ", Level::all_of, out);
            } else if constexpr (std::is_same_v<Node, Union>) {
                return list(n.of, " | ", Level::any_of, out);
            } else if constexpr (std::is_same_v<Node, Difference>) {
                const std::string from = at_least(Level::difference, expression(*n.from, out));
                const std::string take = at_least(Level::all_of, expression(*n.take, out));
                return {fmt::format("{} - {}", from, take), Level::difference};
            } else {
                return transformed(n, out);
            }
        },
        solid.node);
}

void add_photograph_options(Block& block, const Photograph& p)
{
    if (p.linear) block.add("encoding", "linear");
    if (!p.interpolate) block.add("filter", "nearest");
}

std::string print(const Optics& o)
{
    const Optics standard;
    Block block;
    block.add_unless(standard.reflection, "reflection", o.reflection)
        .add_unless(standard.absorption, "absorption", o.absorption)
        .add_unless(standard.index, "index", o.index)
        .add_unless(standard.refraction, "refraction", o.refraction)
        .add_unless(standard.passthrough, "passthrough", o.passthrough);
    if (o.fresnel) block.add("fresnel", "");
    return block.text();
}

std::string print(const decltype(Texture::mapping)& mapping)
{
    Block block;
    std::string_view kind;
    std::visit(
        [&](const auto& m) {
            using Mapping = std::decay_t<decltype(m)>;
            if constexpr (std::is_same_v<Mapping, Planar>) {
                kind = "planar";
                block.add("origin", print(m.origin)).add("u", print(m.u)).add("v", print(m.v));
            } else {
                block.add("n", print(m.n));
                if constexpr (std::is_same_v<Mapping, Directional>) kind = "directional";
                if constexpr (std::is_same_v<Mapping, Positional>) kind = "positional";
                if constexpr (std::is_same_v<Mapping, Relative>) kind = "relative";
                if constexpr (std::is_same_v<Mapping, Linear>) kind = "linear";
                if constexpr (requires { m.origin; }) block.add("origin", print(m.origin));
            }
        },
        mapping);
    return fmt::format("{} {}", kind, block.text());
}

std::string print(const Texture& t)
{
    const Texture standard;
    Block block;
    block.add("photograph", quoted(t.photograph.path));
    add_photograph_options(block, t.photograph);
    block.add("mapping", print(t.mapping));
    if (t.wrap_x != 0 || t.wrap_y != 0) block.add("wrap", fmt::format("[{}, {}]", t.wrap_x, t.wrap_y));
    block.add_unless(standard.reflection, "reflection", t.reflection)
        .add_unless(standard.absorption, "absorption", t.absorption)
        .add_unless(standard.refraction, "refraction", t.refraction);
    return block.text();
}

/// Optics, or textures, of a scene: those with a name are statements, in their order, before the object that needs
/// them; one without a name stands in the one object that uses it.
template <typename Item>
class Items {
public:
    Items(std::string_view word, const std::vector<Item>& items) : word_(word), items_(items), names_(word)
    {
        uses_.resize(items.size());
        printed_.resize(items.size());
    }
    void count(std::size_t index) { ++uses_.at(index); }
    /// A name or a block for the item; definitions are appended to out.
    std::string use(std::size_t index, std::string& out)
    {
        const Item& item = items_.at(index);
        const bool in_place = item.name.empty() && uses_[index] == 1 && next_ <= index;
        define_before(in_place ? index : index + 1, out);
        if (!in_place) return printed_[index];
        next_ = index + 1;
        return print(item);
    }
    void define_rest(std::string& out) { define_before(items_.size(), out); }

private:
    void define_before(std::size_t end, std::string& out)
    {
        for (; next_ < end; ++next_) {
            printed_[next_] = names_.give(items_[next_].name);
            fmt::format_to(std::back_inserter(out), "{} {} {}\n", word_, printed_[next_], print(items_[next_]));
        }
    }

    std::string_view word_;
    const std::vector<Item>& items_;
    Names names_;
    std::vector<std::size_t> uses_;
    std::vector<std::string> printed_;
    std::size_t next_ = 0;
};

std::string print(const Settings& s)
{
    const Settings standard;
    Block block;
    if (s.max_hops != standard.max_hops) block.add("hops", fmt::format("{}", s.max_hops));
    block.add_unless(standard.cutoff, "cutoff", s.cutoff);
    if (s.light_law == LightLaw::lambert) block.add("light_law", "lambert");
    if (s.light_law == LightLaw::inverse_square) block.add("light_law", "inverse_square");
    if (s.media_rule == MediaRule::rank) block.add("media", "rank");
    return s == standard ? "" : fmt::format("settings {}\n", block.text());
}

std::string print(const Sequence& s)
{
    Block block;
    if (s.frames != 0) block.add("frames", fmt::format("{}", s.frames));
    block.add_unless(Sequence{}.fps, "fps", s.fps);
    if (s.loop) block.add("loop", "");
    return s == Sequence{} ? "" : fmt::format("sequence {}\n", block.text());
}

std::string print(const Observer& observer)
{
    Block block;
    if (const auto* o = std::get_if<Pinhole>(&observer)) {
        const Pinhole standard;
        block.add("eye", print(o->eye)).add("look", print(o->look));
        block.add_unless(standard.up, "up", o->up).add_unless(standard.fov, "fov", o->fov);
        return fmt::format("observer {}\n", block.text());
    }
    const auto& o = std::get<Window>(observer);
    block.add("eye", print(o.eye)).add("view", print(o.view)).add("column", print(o.column)).add("row", print(o.row));
    return fmt::format("observer window {}\n", block.text());
}

std::string print(const Sky& sky)
{
    const SkyGradient standard;
    if (const auto* s = std::get_if<SkyColor>(&sky)) {
        return *s == SkyColor{} ? "" : fmt::format("sky color {}\n", print(s->color));
    }
    if (const auto* s = std::get_if<SkyGradient>(&sky)) {
        Block block;
        block.add("low", print(s->low)).add("middle", print(s->middle)).add("high", print(s->high));
        return fmt::format("sky gradient {}\n", block.add_unless(standard.up, "up", s->up).text());
    }
    if (std::holds_alternative<SkyRgb>(sky)) return "sky rgb\n";
    if (std::holds_alternative<SkyHsv>(sky)) return "sky hsv\n";
    const Photograph& p = std::get<SkyPhotograph>(sky).photograph;
    Block options;
    add_photograph_options(options, p);
    const bool plain = !p.linear && p.interpolate;
    return fmt::format("sky photograph {}{}\n", quoted(p.path), plain ? "" : fmt::format(" {}", options.text()));
}

std::string print(const Light& light)
{
    Block block;
    block.add("point", print(light.point)).add_unless(Light{}.color, "color", light.color);
    return fmt::format("light {}\n", block.text());
}

} // namespace

std::string print_scene(const Scene& scene)
{
    std::string out = fmt::format("clucida 1\n{}{}{}{}", print(scene.settings), print(scene.sequence),
                                  print(scene.observer), print(scene.sky));
    for (const Light& light : scene.lights) out += print(light);
    SolidWriter solids(scene);
    Items optics("optics", scene.optics);
    Items textures("texture", scene.textures);
    for (const Object& object : scene.objects) {
        optics.count(object.optics);
        if (object.texture) textures.count(*object.texture);
    }
    Names names("object");
    for (const Object& object : scene.objects) {
        Block block;
        block.add("solid", solids.use(*object.solid, out)).add("optics", optics.use(object.optics, out));
        if (object.texture) block.add("texture", textures.use(*object.texture, out));
        const std::string name = object.name.empty() ? "" : fmt::format("{} ", names.give(object.name));
        fmt::format_to(std::back_inserter(out), "object {}{}\n", name, block.text());
    }
    optics.define_rest(out);
    textures.define_rest(out);
    return out;
}

} // namespace clucida::scene
