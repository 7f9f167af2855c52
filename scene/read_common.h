/// What the readers of all three languages share: the text they read, what makes a value wrong, and where photographs
/// may lie.
#pragma once

#include "scene/error.h"
#include "scene/model.h"
#include "scene/read.h"

#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::scene {

/// A text and its name, and what an error adds: the frame, where there are several.
struct Source {
    std::string file;
    std::string_view text;
    std::string frame = {};
    [[noreturn]] void fail(Location at, const std::string& what) const { throw Error(file, at, what + frame, text); }
};

/// A wrong value: which of a thing's arguments, counted from 0 in the order of its fields, and why.
struct Fault {
    std::size_t argument;
    std::string what;
};

std::optional<Fault> fault_of(const decltype(Solid::node)& primitive);
std::optional<Fault> fault_of(const Pinhole& observer);
std::optional<Fault> fault_of(const Window& observer);
/// The first argument is the mapping's n (or origin, for planar).
std::optional<Fault> fault_of(const decltype(Texture::mapping)& mapping);

/// Throws the fault, if there is one, at its argument's place.
void check(const Source& source, const std::optional<Fault>& fault, const std::vector<Location>& places);
/// Numbers are 0 or of a magnitude that 32-bit floats have.
void check_number(const Source& source, Location at, double value);
void check_filter(const Source& source, Location at, const Rgb& color, std::string_view what);
/// Light may be as bright as it likes, but not negative.
void check_light(const Source& source, Location at, const Rgb& color, std::string_view what);
/// Throws if there are limit of them already.
void check_room(const Source& source, Location at, std::size_t count, std::size_t limit, std::string_view what);

Vec3 operator+(const Vec3& a, const Vec3& b);
Vec3 operator-(const Vec3& a, const Vec3& b);
Vec3 operator*(double a, const Vec3& b);
Vec3 cross(const Vec3& a, const Vec3& b);
double length(const Vec3& a);
bool parallel(const Vec3& a, const Vec3& b); ///< also if one of them is 0

/// A plain decimal number as C++ streams read it (+1 .5 5. 1e-3); nothing if the word is anything else or overflows.
std::optional<double> plain_number(std::string_view word);

/// "; did you mean 'x'?" for the candidate at most two edits away, else nothing.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates);
/// "a, b or c"
std::string listed(const std::vector<std::string_view>& words);

/// Finds photographs beneath the scene's folder or the one allowed besides, and nowhere else.
class PhotographFinder {
public:
    PhotographFinder(const Source& source, const std::filesystem::path& folder, const ReadOptions& options);
    /// The file that path names. @throws Error at `at` if there is none or it lies elsewhere
    const std::string& find(const std::string& path, Location at);

private:
    const Source& source_;
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> roots_;
    std::map<std::string, std::string, std::less<>> found_;
};

/// @throws Error also for parameters that the scene does not have
Scene read_clucida(const Source& source, PhotographFinder& photographs, const Moment& moment, Usage& usage);
Scene read_gun(const Source& source, PhotographFinder& photographs);
Scene read_rayt(const Source& source, PhotographFinder& photographs);

} // namespace clucida::scene
