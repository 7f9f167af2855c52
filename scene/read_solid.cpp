#include "scene/read_solid.h"

#include "scene/limits.h"
#include "scene/read_common.h"

#include <algorithm>
#include <fmt/format.h>

namespace clucida::scene {
namespace {

const std::vector<std::string_view> primitives{"plane",       "sphere", "cylinder", "cone",  "paraboloid",
                                               "hyperboloid", "saddle", "cuboid",   "torus", "quadric"};
const std::vector<std::string_view> transforms{"move", "rotate", "scale"};

bool contains(const std::vector<std::string_view>& words, std::string_view word)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace

/// The arguments of a call, in parentheses, one after the other with the place of each.
struct SolidReader::Arguments {
    Cursor& cursor;
    Expressions& expressions;
    std::string_view call;
    std::vector<Location> places{};

    void next()
    {
        if (places.empty()) cursor.open('(', "after '{}'", call);
        if (!places.empty()) cursor.expect(',', "and another argument of {}", call);
        cursor.skip_blanks();
        places.push_back(cursor.here());
    }
    bool more() const
    {
        cursor.skip_blanks();
        return cursor.peek() == ',';
    }
    Vec3 vector(std::string_view expected)
    {
        next();
        return expressions.vector(cursor, expected, ", a vector [x, y, z]");
    }
    double number(std::string_view expected)
    {
        next();
        return expressions.number(cursor, expected, ", a number");
    }
};

const std::vector<std::string_view>& SolidReader::reserved()
{
    static const std::vector<std::string_view> words = [] {
        std::vector<std::string_view> all = primitives;
        all.insert(all.end(), transforms.begin(), transforms.end());
        return all;
    }();
    return words;
}

void SolidReader::define()
{
    cursor_.skip_blanks();
    const Location at = cursor_.here();
    const std::string name(cursor_.word());
    if (name.empty()) cursor_.fail_expected("a name for the solid");
    if (contains(reserved(), name)) {
        cursor_.fail(at, fmt::format("'{}' has a meaning already; expected another name", name));
    }
    if (const auto first = named_.find(name); first != named_.end()) {
        cursor_.fail(at, fmt::format("solid '{}' is defined in line {} already", name, first->second.line));
    }
    cursor_.expect('=', "after the solid's name");
    Measured solid = any_of();
    // A second name for a solid that has one adds nothing to the scene.
    if (solid.solid->name.empty()) solid.solid = make_solid(solid.solid->node, solid.solid->at, name);
    named_.emplace(name, Named{std::move(solid), at.line});
}

SolidPtr SolidReader::read()
{
    return any_of().solid;
}

Measured SolidReader::bounded(const Measured& solid, Location at) const
{
    if (solid.members > limits::members) {
        cursor_.fail(at, fmt::format("a solid of more than {} primitives, named solids counted wherever they are used",
                                     limits::members));
    }
    if (solid.depth > limits::nesting) {
        cursor_.fail(at, fmt::format("a solid nested more than {} deep, named solids included", limits::nesting));
    }
    return solid;
}

/// A binary operator; what follows it may stand in the next line.
bool SolidReader::accept_operator(char c, Location& at)
{
    cursor_.skip_blanks();
    at = cursor_.here();
    if (!cursor_.accept(c)) return false;
    cursor_.skip_lines();
    return true;
}

Measured SolidReader::any_of()
{
    cursor_.skip_blanks();
    const Location begin = cursor_.here();
    Measured first = difference();
    Location at;
    if (!accept_operator('|', at)) return first;
    std::vector<SolidPtr> of{first.solid};
    Measured sum = first;
    do {
        const Measured next = difference();
        of.push_back(next.solid);
        sum = bounded({nullptr, std::max(sum.depth, next.depth), sum.members + next.members}, at);
    } while (accept_operator('|', at));
    return bounded({make_solid(Union{std::move(of)}, begin), sum.depth + 1, sum.members}, begin);
}

Measured SolidReader::difference()
{
    cursor_.skip_blanks();
    const Location begin = cursor_.here();
    Measured from = all_of();
    Location at;
    while (accept_operator('-', at)) {
        const Measured take = all_of();
        const std::size_t depth = std::max(from.depth, take.depth) + 1;
        from = bounded({make_solid(Difference{from.solid, take.solid}, begin), depth, from.members + take.members}, at);
    }
    return from;
}

Measured SolidReader::all_of()
{
    cursor_.skip_blanks();
    const Location begin = cursor_.here();
    Measured first = unary();
    Location at;
    if (!accept_operator('&', at)) return first;
    std::vector<SolidPtr> of{first.solid};
    Measured sum = first;
    do {
        const Measured next = unary();
        of.push_back(next.solid);
        sum = bounded({nullptr, std::max(sum.depth, next.depth), sum.members + next.members}, at);
    } while (accept_operator('&', at));
    return bounded({make_solid(Intersection{std::move(of)}, begin), sum.depth + 1, sum.members}, begin);
}

Measured SolidReader::unary()
{
    cursor_.skip_blanks();
    if (++nesting_ > limits::nesting) {
        cursor_.fail(cursor_.here(), fmt::format("a solid nested more than {} deep", limits::nesting));
    }
    Measured solid = unary_here();
    --nesting_;
    return solid;
}

Measured SolidReader::unary_here()
{
    const Location at = cursor_.here();
    if (cursor_.accept('!')) {
        const Measured of = unary();
        return bounded({make_solid(Complement{of.solid}, at), of.depth + 1, of.members}, at);
    }
    if (cursor_.peek() == '(') {
        cursor_.open('(', "before a solid");
        Measured solid = any_of();
        cursor_.close(')');
        return solid;
    }
    if (cursor_.peek() == '-') cursor_.fail(at, "'-' takes one solid from another; the complement of one is '!'");
    const std::string_view word = cursor_.word();
    if (word.empty()) cursor_.fail_expected("a solid");
    if (contains(primitives, word)) return primitive(word, at);
    if (contains(transforms, word)) return transform(word, at);
    return named(word, at);
}

Measured SolidReader::named(std::string_view word, Location at)
{
    if (const auto found = named_.find(word); found != named_.end()) return found->second.solid;
    std::vector<std::string_view> names = reserved();
    for (const auto& solid : named_) names.emplace_back(solid.first);
    cursor_.fail(at, fmt::format("unknown solid '{}'; expected one defined above, {}{}", word, listed(primitives),
                                 suggestion(word, names)));
}

Measured SolidReader::primitive(std::string_view word, Location at)
{
    Arguments a{cursor_, expressions_, word};
    decltype(Solid::node) node;
    if (word == "plane") {
        node = Plane{a.vector("a point"), a.vector("the normal")};
    } else if (word == "sphere") {
        node = Sphere{a.vector("the center"), a.number("the radius")};
    } else if (word == "cylinder") {
        Cylinder cylinder{a.vector("a point"), a.vector("the axis")};
        if (a.more()) {
            check(cursor_.source(), fault_of(cylinder), a.places);
            const double radius = a.number("the radius");
            if (!(radius > 0)) cursor_.fail(a.places[2], "expected a radius above 0");
            cylinder.axis = (radius / length(cylinder.axis)) * cylinder.axis;
        }
        node = cylinder;
    } else if (word == "cone") {
        node = Cone{a.vector("the apex"), a.vector("the axis")};
    } else if (word == "paraboloid") {
        node = Paraboloid{a.vector("the vertex"), a.vector("the vector to the focus")};
    } else if (word == "hyperboloid") {
        node = Hyperboloid{a.vector("the center"), a.vector("the axis"), a.number("the waist")};
    } else if (word == "saddle") {
        node = Saddle{a.vector("the center"), a.vector("the axis"), a.vector("the x direction")};
    } else if (word == "torus") {
        node = Torus{a.vector("the center"), a.vector("the axis"), a.number("the major radius"),
                     a.number("the minor radius")};
    } else if (word == "quadric") {
        const Vec3 squares = a.vector("the factors of x^2, y^2, z^2");
        const Vec3 products = a.vector("the factors of x y, x z, y z");
        const Vec3 linear = a.vector("the factors of x, y, z");
        node = FreeQuadric{{squares.x, squares.y, squares.z, products.x, products.y, products.z, linear.x, linear.y,
                            linear.z, a.number("the constant")}};
    } else {
        Cuboid cuboid{a.vector("the center"), {0, 0, 1}, {1, 0, 0}, a.vector("the size or the z axis")};
        if (a.more()) {
            cuboid.z = cuboid.size;
            cuboid.x = a.vector("the x direction");
            cuboid.size = a.vector("the size");
        } else {
            a.places = {a.places[0], a.places[0], a.places[0], a.places[1]};
        }
        node = cuboid;
    }
    cursor_.close(')');
    check(cursor_.source(), fault_of(node), a.places);
    return {make_solid(std::move(node), at)};
}

Measured SolidReader::transform(std::string_view word, Location at)
{
    Arguments a{cursor_, expressions_, word};
    decltype(Transformed::by) by;
    std::optional<Vec3> center;
    if (word == "move") {
        by = Move{a.vector("a displacement")};
    } else if (word == "rotate") {
        const Rotate rotate{a.vector("the axis"), a.number("the angle in degrees")};
        if (rotate.axis == Vec3{}) cursor_.fail(a.places[0], "the axis is 0; expected a vector of some length");
        by = rotate;
    } else {
        a.next();
        const Scale scale{expressions_.vector_or_number(cursor_, "a factor or a vector of factors")};
        if (scale.by.x == 0 || scale.by.y == 0 || scale.by.z == 0) {
            cursor_.fail(a.places[0], "a factor of 0 would flatten the solid; expected factors other than 0");
        }
        by = scale;
    }
    a.next();
    if (word == "rotate" && expressions_.at_vector(cursor_)) {
        center = expressions_.vector(cursor_);
        a.next();
    }
    Measured of = any_of();
    cursor_.close(')');
    if (center) of = {make_solid(Transformed{Move{Vec3{} - *center}, of.solid}, at), of.depth + 1, of.members};
    of = {make_solid(Transformed{by, of.solid}, at), of.depth + 1, of.members};
    if (center) of = {make_solid(Transformed{Move{*center}, of.solid}, at), of.depth + 1, of.members};
    return bounded(of, at);
}

} // namespace clucida::scene
