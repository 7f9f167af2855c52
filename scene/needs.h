/// What a scene asks of the kernels: a small mask of features and four capacities. It selects a variant of the
/// program; counts and coordinates never do, so one build serves a whole sequence.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace clucida::scene {

enum Feature : std::uint32_t {
    feature_plane = 1u << 0,
    feature_sphere = 1u << 1,
    feature_quadric = 1u << 2,
    feature_groups = 1u << 3,      ///< objects of more than one group
    feature_program = 1u << 4,     ///< boolean programs
    feature_transparent = 1u << 5, ///< refraction
    feature_extinction = 1u << 6,  ///< passthrough other than 1
    feature_emission = 1u << 7,
    feature_fresnel = 1u << 8,
    feature_texture = 1u << 9,
    feature_light_paper = 1u << 10,
    feature_light_lambert = 1u << 11,
    feature_light_inverse_square = 1u << 12,
    feature_sky_gradient = 1u << 13, ///< a plain colour needs no flag
    feature_sky_rgb = 1u << 14,
    feature_sky_hsv = 1u << 15,
    feature_sky_photograph = 1u << 16,
    feature_media_rank = 1u << 17,
    feature_as_gun = 1u << 18,
    feature_as_rayt = 1u << 19,
    feature_torus = 1u << 20,
};

struct FeatureName {
    Feature feature;
    const char* name; ///< as `inspect` prints it; the kernel's macro is CLU_ and the name in capitals
};
std::span<const FeatureName> feature_names();

struct Needs {
    std::uint32_t features = 0;
    unsigned interior = 1; ///< objects that may hold one point: capacity class
    unsigned stack = 0;    ///< pending branches of a ray: capacity class
    unsigned groups = 1;   ///< groups of the largest object: capacity class
    unsigned walk = 8;     ///< nodes and objects that wait on a walk through the tree: capacity class
    bool operator==(const Needs&) const = default;
};

/// The needs of both, as a sequence's frames have them.
Needs unite(const Needs& a, const Needs& b);

/// Compiler options (-D...) that select the variant.
std::string build_options(const Needs& needs);

} // namespace clucida::scene
