#include "scene/needs.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace clucida::scene {

std::span<const FeatureName> feature_names()
{
    static constexpr std::array names{
        FeatureName{feature_plane, "plane"},
        FeatureName{feature_sphere, "sphere"},
        FeatureName{feature_quadric, "quadric"},
        FeatureName{feature_groups, "groups"},
        FeatureName{feature_program, "program"},
        FeatureName{feature_transparent, "transparent"},
        FeatureName{feature_extinction, "extinction"},
        FeatureName{feature_emission, "emission"},
        FeatureName{feature_fresnel, "fresnel"},
        FeatureName{feature_texture, "texture"},
        FeatureName{feature_light_paper, "light_paper"},
        FeatureName{feature_light_lambert, "light_lambert"},
        FeatureName{feature_light_inverse_square, "light_inverse_square"},
        FeatureName{feature_sky_gradient, "sky_gradient"},
        FeatureName{feature_sky_rgb, "sky_rgb"},
        FeatureName{feature_sky_hsv, "sky_hsv"},
        FeatureName{feature_sky_photograph, "sky_photograph"},
        FeatureName{feature_media_rank, "media_rank"},
        FeatureName{feature_as_gun, "as_gun"},
        FeatureName{feature_as_rayt, "as_rayt"},
        FeatureName{feature_torus, "torus"},
    };
    return names;
}

Needs unite(const Needs& a, const Needs& b)
{
    return {a.features | b.features, std::max(a.interior, b.interior), std::max(a.stack, b.stack),
            std::max(a.groups, b.groups), std::max(a.walk, b.walk)};
}

std::string build_options(const Needs& needs)
{
    std::string options;
    for (const FeatureName& feature : feature_names()) {
        if ((needs.features & feature.feature) == 0) continue;
        options += "-DCLU_";
        for (const char* c = feature.name; *c != '\0'; c++)
            options += static_cast<char>(std::toupper(static_cast<unsigned char>(*c)));
        options += ' ';
    }
    if ((needs.features & (feature_light_paper | feature_light_lambert | feature_light_inverse_square)) != 0)
        options += "-DCLU_LIGHTS ";
    options += "-DCLU_INTERIOR_CAPACITY=" + std::to_string(needs.interior);
    options += " -DCLU_STACK_CAPACITY=" + std::to_string(needs.stack);
    options += " -DCLU_GROUP_CAPACITY=" + std::to_string(needs.groups);
    options += " -DCLU_WALK_CAPACITY=" + std::to_string(needs.walk);
    return options;
}

} // namespace clucida::scene
