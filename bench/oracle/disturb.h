/// A scene disturbed by about a rounding, to tell whether a path that differs is explained by rounding.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace clucida::oracle {

/// Every number x of the scene becomes x (1 + size h), with h in -1..1 a hash of the seed and of |x|. So do the numbers
/// of every ray as it starts, its origin counted from the observer's eye, each with an h of its own.
struct Disturbance {
    std::uint64_t seed = 0;
    double size = 0;
    bool apart = false; ///< equal numbers of different objects become different: faces are flush to rounding only
    /// Surfaces that a disturbance of that size can bring to one place along the ray are met there as one. (That they
    /// meet exactly is among what may happen, but no random disturbance finds it.)
    bool merging = false;
};

/// In -1..1 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, the mixing of splitmix64).
inline double noise(std::uint64_t seed, std::uint64_t key)
{
    std::uint64_t z = seed * 0xd1342543de82ef95U + key * 0x9e3779b97f4a7c15U + 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    z ^= z >> 31U;
    return static_cast<double>(static_cast<std::int64_t>(z)) * 0x1p-63;
}

/// What numbers are equal: those that agree to 30 bits, since faces are flush by arithmetic that rounds.
inline std::uint64_t key_of(double x)
{
    const double size = std::fabs(x);
    if (!(size > 1e-12)) return 0;
    int exponent = 0;
    const double mantissa = std::frexp(size, &exponent);
    const auto bits = static_cast<std::uint64_t>(std::llround(mantissa * 0x1p30));
    // 2^30 is 2^29 of the next exponent.
    const bool carry = bits == (std::uint64_t{1} << 30U);
    return (carry ? bits >> 1U : bits) + (static_cast<std::uint64_t>(exponent + (carry ? 1 : 0) + 2000) << 32U);
}

/// The factor of the number x of an object, or of what belongs to none (0).
inline double disturbed_by(const std::optional<Disturbance>& disturbance, double x, std::uint64_t object)
{
    if (!disturbance) return 1;
    const std::uint64_t own = disturbance->apart ? object << 40U : 0;
    return 1 + disturbance->size * noise(disturbance->seed, key_of(x) ^ own);
}

} // namespace clucida::oracle
