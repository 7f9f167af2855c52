/// A scene as the oracle holds it: in one real type, every primitive in scene coordinates.
#pragma once

#include "bench/oracle/bounds.h"
#include "bench/oracle/disturb.h"
#include "bench/oracle/image.h"
#include "bench/oracle/solids.h"
#include "scene/compile.h"
#include "scene/model.h"

namespace clucida::oracle {

struct Options {
    scene::View view;
    bool stored_colors = false; ///< filters as the kernels store them, in 32 bits; else exact
    std::optional<Disturbance> disturbance;
};

template <class Real>
using Rgb = std::array<Real, 3>;

template <class Real>
struct Optics {
    Rgb<Real> reflection, absorption, refraction;
    Rgb<Real> extinction;                   ///< -ln(passthrough) per unit of length; of no meaning where it is blocked
    std::array<bool, 3> clear{}, blocked{}; ///< passthrough of 1, of 0
    Real index = 0;
    bool fresnel = false;
    double rank = 0; ///< how much it lets through, as the original program counts
};

template <class Real>
struct Texture {
    std::shared_ptr<const Image> image;
    decltype(scene::Texture::mapping) mapping;
    Mat<Real> frame; ///< of all mappings but planar
    Real size = 1;   ///< |n|
    Vec<Real> origin;
    Vec<Real> across, down; ///< planar: (u, v) = (across, down) * (p - origin)
    Real wrap_x = 0, wrap_y = 0;
    Rgb<Real> reflection, absorption, refraction;
};

template <class Real>
struct Object {
    std::vector<Primitive<Real>> primitives; ///< the object's faces, in the order of its text
    std::vector<Rough> rough;
    Tree tree;
    Box box;
    std::uint32_t optics = 0;
    std::optional<std::uint32_t> texture;
};

template <class Real>
struct Light {
    Vec<Real> point;
    Rgb<Real> color;
};

template <class Real>
struct Sky {
    decltype(scene::Scene::sky) kind;
    Vec<Real> up;
    Rgb<Real> low, middle, high;
    std::shared_ptr<const Image> image;
};

/// A ray of the observer's starts at eye + window (u column + v row) and goes along forward + u column + v row, with
/// u, v in -1/2..1/2 across the picture and down it.
template <class Real>
struct Observer {
    Vec<Real> eye, forward, column, row;
    bool window = false;
};

template <class Real>
struct World {
    std::vector<Object<Real>> objects;
    std::vector<Optics<Real>> optics;
    std::vector<Texture<Real>> textures;
    std::vector<Light<Real>> lights;
    Sky<Real> sky;
    Observer<Real> observer;
    scene::LightLaw light_law = scene::LightLaw::paper;
    scene::MediaRule media_rule = scene::MediaRule::nearest;
    unsigned width = 0, height = 0, max_hops = 19;
    Real cutoff = 0;
    std::optional<Disturbance> disturbance;
};

/// @throws std::invalid_argument where the view asks for the original program's behaviour; scene::Error for a
/// photograph that cannot be read
template <class Real>
World<Real> build(const scene::Scene& scene, const Options& options);

} // namespace clucida::oracle
