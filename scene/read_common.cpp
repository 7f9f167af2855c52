#include "scene/read_common.h"

#include "scene/limits.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <system_error>
#include <type_traits>

namespace clucida::scene {
namespace {

namespace fs = std::filesystem;

constexpr double parallel_sine = 1e-9;

bool zero(const Vec3& v)
{
    return v == Vec3{};
}

Fault zero_vector(std::size_t argument, std::string_view what)
{
    return {argument, fmt::format("{} is 0; expected a vector of some length", what)};
}

Fault not_positive(std::size_t argument, std::string_view what)
{
    return {argument, fmt::format("expected {} above 0", what)};
}

std::optional<Fault> fault_of_frame(const Vec3& axis, const Vec3& x)
{
    if (zero(axis)) return zero_vector(1, "the axis");
    if (zero(x)) return zero_vector(2, "the x direction");
    if (parallel(axis, x)) return Fault{2, "the x direction is parallel to the axis; expected it to stand off"};
    return {};
}

std::optional<Fault> fault_of_cuboid(const Cuboid& c)
{
    if (auto fault = fault_of_frame(c.z, c.x)) return fault;
    if (c.size.x < 0 || c.size.y < 0 || c.size.z < 0) return Fault{3, "expected sizes above 0, or 0 for unbounded"};
    if (zero(c.size)) return Fault{3, "every size is 0, that is unbounded; expected one above 0"};
    return {};
}

std::optional<Fault> fault_of_torus(const Torus& t)
{
    if (zero(t.axis)) return zero_vector(1, "the axis");
    if (!(t.major > 0)) return not_positive(2, "a major radius");
    if (!(t.minor > 0)) return not_positive(3, "a minor radius");
    if (!(t.minor < t.major))
        return Fault{3,
                     fmt::format("the torus would meet itself; expected a minor radius below the major, {}", t.major)};
    return {};
}

/// Whether path lies in root, both canonical.
bool beneath(const fs::path& path, const fs::path& root)
{
    const auto [r, p] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
    return r == root.end() || (r->empty() && std::next(r) == root.end());
}

std::size_t edits(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

} // namespace

std::optional<Fault> fault_of(const decltype(Solid::node)& primitive)
{
    return std::visit(
        [](const auto& p) -> std::optional<Fault> {
            using Node = std::decay_t<decltype(p)>;
            if constexpr (std::is_same_v<Node, Plane>) {
                if (zero(p.normal)) return zero_vector(1, "the normal");
            } else if constexpr (std::is_same_v<Node, Sphere>) {
                if (!(p.radius > 0)) return not_positive(1, "a radius");
            } else if constexpr (std::is_same_v<Node, Cylinder> || std::is_same_v<Node, Cone>) {
                if (zero(p.axis)) return zero_vector(1, "the axis");
            } else if constexpr (std::is_same_v<Node, Paraboloid>) {
                if (zero(p.focus)) return zero_vector(1, "the vector to the focus");
            } else if constexpr (std::is_same_v<Node, Hyperboloid>) {
                if (zero(p.axis)) return zero_vector(1, "the axis");
                if (!(p.waist > 0)) return not_positive(2, "a waist");
            } else if constexpr (std::is_same_v<Node, Saddle>) {
                return fault_of_frame(p.axis, p.x);
            } else if constexpr (std::is_same_v<Node, Cuboid>) {
                return fault_of_cuboid(p);
            } else if constexpr (std::is_same_v<Node, Torus>) {
                return fault_of_torus(p);
            } else if constexpr (std::is_same_v<Node, FreeQuadric>) {
                if (!has_boundary(p)) {
                    return Fault{0, "this quadric has no boundary: it is below 0 nowhere or everywhere; expected "
                                    "factors of either sign"};
                }
            }
            return {};
        },
        primitive);
}

std::optional<Fault> fault_of(const Pinhole& o)
{
    if (o.eye == o.look) return Fault{1, "the eye looks at itself; expected look and eye to differ"};
    if (zero(o.up)) return zero_vector(2, "up");
    if (parallel(o.look - o.eye, o.up)) return Fault{2, "up is parallel to the view; expected it to stand off"};
    if (!(o.fov > 0 && o.fov < 180)) return Fault{3, "expected a field of view above 0 and below 180 degrees"};
    return {};
}

std::optional<Fault> fault_of(const Window& o)
{
    if (o.eye == o.view) return Fault{1, "the eye looks at itself; expected view and eye to differ"};
    if (zero(o.column)) return zero_vector(2, "the column");
    if (zero(o.row)) return zero_vector(3, "the row");
    return {};
}

std::optional<Fault> fault_of(const decltype(Texture::mapping)& mapping)
{
    if (const auto* planar = std::get_if<Planar>(&mapping)) {
        if (zero(planar->u)) return zero_vector(1, "u");
        if (zero(planar->v)) return zero_vector(2, "v");
        if (parallel(planar->u, planar->v)) return Fault{2, "v is parallel to u; expected it to stand off"};
        return {};
    }
    return std::visit(
        [](const auto& m) -> std::optional<Fault> {
            if constexpr (!std::is_same_v<std::decay_t<decltype(m)>, Planar>) {
                if (zero(m.n)) return zero_vector(0, "n");
            }
            return {};
        },
        mapping);
}

void check(const Source& source, const std::optional<Fault>& fault, const std::vector<Location>& places)
{
    if (fault) source.fail(places.at(fault->argument), fault->what);
}

void check_number(const Source& source, Location at, double value)
{
    if (!std::isfinite(value)) source.fail(at, fmt::format("the value is {}; expected a finite number", value));
    const double size = std::abs(value);
    if (size != 0 && (size < limits::smallest || size > limits::largest)) {
        source.fail(at, fmt::format("{} is out of range; expected 0 or a magnitude within {:.3g} and {:.3g}", value,
                                    limits::smallest, limits::largest));
    }
}

void check_filter(const Source& source, Location at, const Rgb& color, std::string_view what)
{
    for (const double x : {color.r, color.g, color.b}) {
        if (!(x >= 0 && x <= 1)) source.fail(at, fmt::format("{} is {}; expected a filter within 0 and 1", what, x));
    }
}

void check_light(const Source& source, Location at, const Rgb& color, std::string_view what)
{
    for (const double x : {color.r, color.g, color.b}) {
        if (!(x >= 0)) source.fail(at, fmt::format("{} is {}; expected no negative light", what, x));
    }
}

void check_room(const Source& source, Location at, std::size_t count, std::size_t limit, std::string_view what)
{
    if (count >= limit) source.fail(at, fmt::format("too many {}; expected {} at most", what, limit));
}

Vec3 operator+(const Vec3& a, const Vec3& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec3 operator-(const Vec3& a, const Vec3& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3 operator*(double a, const Vec3& b)
{
    return {a * b.x, a * b.y, a * b.z};
}
Vec3 cross(const Vec3& a, const Vec3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const Vec3& a)
{
    return std::hypot(a.x, a.y, a.z);
}
bool parallel(const Vec3& a, const Vec3& b)
{
    return length(cross(a, b)) <= parallel_sine * length(a) * length(b);
}

std::optional<double> plain_number(std::string_view word)
{
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-')) return {};
    }
    const std::string_view digits = word.starts_with('-') ? word.substr(1) : word;
    // from_chars also knows "inf" and "nan".
    if (digits.empty() || !((digits[0] >= '0' && digits[0] <= '9') || digits[0] == '.')) return {};
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return {};
    return value;
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates)
{
    constexpr std::size_t far = 3;
    std::size_t best = std::min(far, word.size() / 2 + 1); // of a short word, less is left to recognise
    std::string_view nearest;
    for (const std::string_view candidate : candidates) {
        if (candidate.size() + far <= word.size() || word.size() + far <= candidate.size()) continue;
        if (const std::size_t distance = edits(word, candidate); distance < best) {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::string listed(const std::vector<std::string_view>& words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

PhotographFinder::PhotographFinder(const Source& source, const fs::path& folder, const ReadOptions& options)
    : source_(source), folder_(folder.empty() ? fs::path(".") : folder)
{
    std::error_code error;
    folder_ = fs::weakly_canonical(folder_, error);
    roots_.push_back(folder_);
    if (options.allow_path) roots_.push_back(fs::weakly_canonical(*options.allow_path, error));
}

const std::string& PhotographFinder::find(const std::string& path, Location at)
{
    if (const auto known = found_.find(path); known != found_.end()) return known->second;
    if (path.empty()) source_.fail(at, "expected the path of a photograph");
    if (path.size() > limits::path_length) source_.fail(at, "the path is too long");
    const auto allowed = [&](const fs::path& file) {
        return std::any_of(roots_.begin(), roots_.end(), [&](const fs::path& root) { return beneath(file, root); });
    };
    bool outside = false;
    for (const fs::path& root : roots_) {
        const fs::path named = (root / path).lexically_normal();
        // Refused by its name already, so that the message tells nothing of what lies outside.
        if (!allowed(named)) {
            outside = true;
            continue;
        }
        std::error_code error;
        const fs::path file = fs::canonical(named, error);
        if (error) continue;
        if (!allowed(file)) {
            outside = true;
            continue;
        }
        if (!fs::is_regular_file(file, error)) source_.fail(at, fmt::format("'{}' is no file", path));
        return found_.emplace(path, file.string()).first->second;
    }
    if (outside) {
        source_.fail(at, fmt::format("'{}' leads out of the scene's folder; expected a photograph beneath it, or "
                                     "beneath the folder of --allow-path",
                                     path));
    }
    source_.fail(at, fmt::format("there is no photograph '{}' in the scene's folder", path));
}

} // namespace clucida::scene
