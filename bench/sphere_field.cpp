#include "bench/sphere_field.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>

namespace clucida::bench {
namespace {

constexpr std::array<double, 3> half_sizes{1.8, 1, 1}; ///< of the block
constexpr unsigned kinds = 8;                          ///< of optics, the first half of them glass

/// The radius at which the spheres have together the block's cross-section.
double radius_of(unsigned count)
{
    return std::sqrt(4 * half_sizes[0] * half_sizes[2] / (std::numbers::pi * count));
}

/// 0..1; as std::uniform_real_distribution's are not, the same with each standard library.
double fraction(std::mt19937& random)
{
    return random() * 0x1p-32;
}

} // namespace

std::string sphere_field(unsigned count)
{
    std::mt19937 random(count);
    std::string out = "clucida 1\n"
                      "observer { eye [0, -4, 0]; look [0, 0, 0]; fov 31 }\n"
                      "sky gradient { low 0.2; middle 0.8; high [0.2, 0.4, 1] }\n"
                      "light { point [-4, -6, 5] }\n";
    const auto to = std::back_inserter(out);
    for (unsigned kind = 0; kind < kinds; ++kind) {
        const double r = fraction(random), g = fraction(random), b = fraction(random);
        if (kind < kinds / 2)
            fmt::format_to(to,
                           "optics o{} {{ reflection 0.1; refraction [{:.3f}, {:.3f}, {:.3f}]; index 1.5; "
                           "passthrough 1 }}\n",
                           kind, 0.7 + 0.3 * r, 0.7 + 0.3 * g, 0.7 + 0.3 * b);
        else
            fmt::format_to(to, "optics o{} {{ reflection 0.2; absorption [{:.3f}, {:.3f}, {:.3f}] }}\n", kind,
                           0.3 + 0.7 * r, 0.3 + 0.7 * g, 0.3 + 0.7 * b);
    }
    const double radius = radius_of(count);
    for (unsigned i = 0; i < count; ++i) {
        std::array<double, 3> at{};
        for (std::size_t k = 0; k < at.size(); ++k) at[k] = half_sizes[k] * (2 * fraction(random) - 1);
        fmt::format_to(to, "object {{ solid sphere([{:.6f}, {:.6f}, {:.6f}], {:.6f}); optics o{} }}\n", at[0], at[1],
                       at[2], radius, random() % kinds);
    }
    return out;
}

} // namespace clucida::bench
