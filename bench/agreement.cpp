#include "bench/agreement.h"

#include "host/compare.h"
#include "host/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace clucida::bench {
namespace {

/// A float's place among all floats: neighbours differ by 1, and both zeros share a place.
std::int64_t rank(std::uint32_t bits)
{
    const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffU);
    return bits >> 31 ? -magnitude : magnitude;
}

bool is_number(std::uint32_t bits)
{
    return !std::isnan(std::bit_cast<float>(bits));
}

host::Picture picture_of(const Render& r, host::Shape size)
{
    host::Picture out = host::make_picture(size.width, size.height);
    for (std::size_t i = 0; i < out.rgb.size(); ++i) out.rgb[i] = std::bit_cast<float>(r.rgb[i]);
    return out;
}

} // namespace

Place parse_place(std::string_view text)
{
    Place out;
    out.name = text;
    while (!text.empty()) {
        const auto end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        const auto equals = word.find('=');
        if (equals == std::string_view::npos || equals == 0) break;
        out.environment[std::string(word.substr(0, equals))] = word.substr(equals + 1);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    out.selector = text;
    if (out.selector.empty() && !out.environment.empty())
        throw host::UsageError(fmt::format("'{}' names no device; expected [NAME=VALUE ...] WHICH", out.name));
    return out;
}

std::uint64_t ulps_between(std::uint32_t a, std::uint32_t b)
{
    if (a == b) return 0;
    if (!is_number(a) || !is_number(b)) return std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint64_t>(std::abs(rank(a) - rank(b)));
}

Agreement agree(const Render& a, const Render& b, host::Shape size)
{
    const std::size_t pixels = host::area(size);
    for (const Render* r : {&a, &b})
        if (r->rgb.size() != 3 * pixels || (!r->paths.empty() && r->paths.size() != pixels))
            throw host::Failure("a picture is not of the size that was asked for");
    const auto bytes_a = host::develop_8(picture_of(a, size), host::Transfer::srgb);
    const auto bytes_b = host::develop_8(picture_of(b, size), host::Transfer::srgb);
    Agreement out;
    out.values = 3 * pixels;
    out.pixels = pixels;
    const bool told = !a.paths.empty() && !b.paths.empty();
    out.paths = told ? pixels : 0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        unsigned steps = 0;
        bool differs = false;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const std::uint64_t ulps = ulps_between(a.rgb[i], b.rgb[i]);
            out.equal += ulps == 0;
            differs = differs || ulps != 0;
            out.most_ulps = std::max(out.most_ulps, ulps);
            steps = std::max(steps, static_cast<unsigned>(std::abs(bytes_a[i] - bytes_b[i])));
        }
        const bool flip = told && a.paths[pixel] != b.paths[pixel];
        out.most_steps = std::max(out.most_steps, steps);
        out.over += steps > 1;
        out.flips += flip;
        out.other += told && differs && !flip;
    }
    return out;
}

Agreement united(const Agreement& a, const Agreement& b)
{
    return {a.values + b.values,
            a.equal + b.equal,
            std::max(a.most_ulps, b.most_ulps),
            std::max(a.most_steps, b.most_steps),
            a.pixels + b.pixels,
            a.over + b.over,
            a.paths + b.paths,
            a.flips + b.flips,
            a.other + b.other};
}

} // namespace clucida::bench
