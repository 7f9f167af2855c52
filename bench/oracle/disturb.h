/// A scene disturbed by about a rounding, to tell whether a path that differs is explained by rounding.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace clucida::oracle {

/// Every number x of the scene becomes x (1 + size h), with h in -1..1 a hash of the seed and of |x|; so do the
/// coordinates of the observer's rays' origins, each with an h of its own. Of every ray's direction, as it starts, each
/// component changes by size h of the direction's length.
struct Disturbance {
    std::uint64_t seed = 0;
    double size = 0;
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

/// The factor of the number x.
inline double disturbed_by(const std::optional<Disturbance>& disturbance, double x)
{
    return disturbance ? 1 + disturbance->size * noise(disturbance->seed, key_of(x)) : 1;
}

} // namespace clucida::oracle
