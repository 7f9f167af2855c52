/// What is to be seen, as plain values. The rules are those of docs/optics.md.
/// Lengths are in scene units, angles in degrees, colours linear light. Readers make scenes, the writer prints them,
/// the compiler turns them into buffers.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace clucida::scene {

struct Vec3 {
    double x = 0, y = 0, z = 0;
    bool operator==(const Vec3&) const = default;
};

struct Rgb {
    double r = 0, g = 0, b = 0;
    bool operator==(const Rgb&) const = default;
};

/// Where a thing stands in its text; line and column count from 1, line 0 means nowhere.
struct Location {
    std::size_t line = 0, column = 0;
    bool operator==(const Location&) const { return true; } ///< never part of a thing's value
};

// Primitives: each is a solid, named by docs/scene-language.md.
struct Plane {
    Vec3 point, normal;
    bool operator==(const Plane&) const = default;
}; ///< behind the normal
struct Sphere {
    Vec3 center;
    double radius = 1;
    bool operator==(const Sphere&) const = default;
};
struct Cylinder {
    Vec3 point, axis;
    bool operator==(const Cylinder&) const = default;
}; ///< |axis|: radius
struct Cone {
    Vec3 apex, axis;
    bool operator==(const Cone&) const = default;
}; ///< radius 1 at |axis|
struct Paraboloid {
    Vec3 vertex, focus;
    bool operator==(const Paraboloid&) const = default;
}; ///< side of the focus
struct Hyperboloid {
    Vec3 center, axis;
    double waist = 1;
    bool operator==(const Hyperboloid&) const = default;
};
struct Saddle {
    Vec3 center, axis, x;
    bool operator==(const Saddle&) const = default;
};
struct Cuboid {
    Vec3 center, z, x, size;
    bool operator==(const Cuboid&) const = default;
}; ///< size in order x, y, z; 0 in a size: unbounded there
struct Torus {
    Vec3 center, axis;
    double major = 1, minor = 0.25;
    bool operator==(const Torus&) const = default;
}; ///< of the axis the direction counts; minor < major
struct FreeQuadric {
    /// Of x^2, y^2, z^2, x y, x z, y z, x, y, z and 1: the order of POV-Ray's quadric.
    std::array<double, 10> q{};
    bool operator==(const FreeQuadric&) const = default;
}; ///< where their sum is below 0
/// Else it is empty, the whole space, or either but for a point, a line or a plane.
bool has_boundary(const FreeQuadric& quadric);

// Transforms.
struct Move {
    Vec3 by;
    bool operator==(const Move&) const = default;
};
struct Rotate {
    Vec3 axis;
    double degrees = 0;
    bool operator==(const Rotate&) const = default;
}; ///< right-handed, about the origin
struct Scale {
    Vec3 by;
    bool operator==(const Scale&) const = default;
}; ///< about the origin; no factor 0

struct Solid;
/// Solids are immutable and shared: a named solid is one node, however often it is used.
using SolidPtr = std::shared_ptr<const Solid>;

struct Complement {
    SolidPtr of;
};
struct Intersection {
    std::vector<SolidPtr> of;
}; ///< two or more
struct Union {
    std::vector<SolidPtr> of;
}; ///< two or more
struct Difference {
    SolidPtr from, take;
};
struct Transformed {
    std::variant<Move, Rotate, Scale> by;
    SolidPtr of;
};

struct Solid {
    std::variant<Plane, Sphere, Cylinder, Cone, Paraboloid, Hyperboloid, Saddle, Cuboid, Torus, FreeQuadric, Complement,
                 Intersection, Union, Difference, Transformed>
        node;
    std::string name; ///< empty if it was not named
    Location at;
};
bool operator==(const Solid& a, const Solid& b); ///< deep
inline SolidPtr make_solid(decltype(Solid::node) node, Location at = {}, std::string name = {})
{
    return std::make_shared<const Solid>(Solid{std::move(node), std::move(name), at});
}

struct Optics {
    std::string name;
    Rgb reflection, absorption;
    double index = 0; ///< 0 opaque, negative: emits its refraction colour
    Rgb refraction;
    Rgb passthrough{1, 1, 1}; ///< transmittance per unit of length
    bool fresnel = false;
    Location at;
    bool operator==(const Optics&) const = default;
};

/// A photograph that a scene names. path is as written, file what it resolved to.
struct Photograph {
    std::string path;
    std::string file;
    bool linear = false;     ///< its bytes are linear light; else sRGB
    bool interpolate = true; ///< bilinear; else the nearest texel below
    Location at;
    bool operator==(const Photograph& o) const
    {
        return path == o.path && linear == o.linear && interpolate == o.interpolate;
    }
};

// Mappings of a photograph onto a surface (docs/scene-language.md has the formulas).
struct Directional {
    Vec3 n;
    bool operator==(const Directional&) const = default;
};
struct Positional {
    Vec3 n;
    bool operator==(const Positional&) const = default;
};
struct Relative {
    Vec3 n, origin;
    bool operator==(const Relative&) const = default;
};
struct Linear {
    Vec3 n, origin;
    bool operator==(const Linear&) const = default;
}; ///< axial
struct Planar {
    Vec3 origin, u, v;
    bool operator==(const Planar&) const = default;
}; ///< one photograph spans u and v

struct Texture {
    std::string name;
    Photograph photograph;
    std::variant<Directional, Positional, Relative, Linear, Planar> mapping;
    double wrap_x = 0, wrap_y = 0;
    Rgb reflection, absorption, refraction; ///< factors of the photograph, added to the object's own
    Location at;
    bool operator==(const Texture&) const = default;
};

struct Object {
    std::string name;
    SolidPtr solid;
    std::size_t optics = 0;             ///< index into Scene::optics
    std::optional<std::size_t> texture; ///< index into Scene::textures
    Location at;
};
bool operator==(const Object& a, const Object& b);

struct Light {
    Vec3 point;
    Rgb color{1, 1, 1};
    Location at;
    bool operator==(const Light&) const = default;
};

struct SkyColor {
    Rgb color;
    bool operator==(const SkyColor&) const = default;
};
struct SkyGradient {
    Vec3 up{0, 0, 1};
    Rgb low, middle, high;
    bool operator==(const SkyGradient&) const = default;
}; ///< linear in the direction's cosine
struct SkyRgb {
    bool operator==(const SkyRgb&) const = default;
};
struct SkyHsv {
    bool operator==(const SkyHsv&) const = default;
};
struct SkyPhotograph {
    Photograph photograph;
    bool operator==(const SkyPhotograph&) const = default;
};
using Sky = std::variant<SkyColor, SkyGradient, SkyRgb, SkyHsv, SkyPhotograph>;

/// Rays leave the eye; the picture is fov degrees high.
struct Pinhole {
    Vec3 eye, look, up{0, 0, 1};
    double fov = 45;
    bool operator==(const Pinhole&) const = default;
};
/// The original program's: rays leave a window of the picture's size at the eye (docs/scene-language.md has the
/// formula).
struct Window {
    Vec3 eye, view, column, row;
    bool operator==(const Window&) const = default;
};
using Observer = std::variant<Pinhole, Window>;

enum class LightLaw { paper, lambert, inverse_square };
enum class MediaRule { nearest, rank };

struct Settings {
    unsigned max_hops = 19;
    double cutoff = 1.0 / 256;
    LightLaw light_law = LightLaw::paper;
    MediaRule media_rule = MediaRule::nearest;
    bool operator==(const Settings&) const = default;
};

/// What the scene says of the sequence that it is a frame of.
struct Sequence {
    unsigned frames = 0; ///< 1 to limits::frames; 0: it does not say
    double fps = 24;     ///< frames per second
    bool loop = false;   ///< the frame after the last would be the first
    bool operator==(const Sequence&) const = default;
};

struct Scene {
    Sequence sequence;
    Observer observer;
    Sky sky;
    Settings settings;
    std::vector<Optics> optics;
    std::vector<Texture> textures;
    std::vector<Object> objects; ///< in order of precedence, the highest first
    std::vector<Light> lights;
    bool operator==(const Scene&) const = default;
};

} // namespace clucida::scene
