/// What colours come from: texels, textures, skies, lights.
#pragma once

#include "bench/oracle/search_impl.h"

namespace clucida::oracle {

template <class Real>
Real fraction(const Real& x)
{
    return x - floor(x);
}

/// At (x, y) in texels from the upper left corner. Nearest: the texel that contains it, black outside. Bilinear:
/// between the four nearest texels' middles, the edge going on outside; around the picture's sides if it repeats.
template <class Real>
Rgb<Real> look_up(const Image& image, const Real& x, const Real& y, bool repeat_x, bool repeat_y)
{
    const auto width = static_cast<long>(image.width), height = static_cast<long>(image.height);
    const auto whole = [](const Real& v) { return static_cast<long>(to_double(Real(floor(v)))); };
    if (!image.interpolate) {
        const long i = whole(x), j = whole(y);
        if (i < 0 || j < 0 || i >= width || j >= height) return {Real(0), Real(0), Real(0)};
        const auto& texel = image.texels[static_cast<std::size_t>(j * width + i)];
        return {Real(texel[0]), Real(texel[1]), Real(texel[2])};
    }
    const auto within = [](long i, long size, bool repeat) {
        return repeat ? (i % size + size) % size : std::clamp(i, 0L, size - 1);
    };
    const Real left = x - Real(0.5), top = y - Real(0.5);
    const long i = whole(left), j = whole(top);
    const Real fx = left - Real(static_cast<double>(i)), fy = top - Real(static_cast<double>(j));
    Rgb<Real> sum{Real(0), Real(0), Real(0)};
    for (const long dj : {0L, 1L}) {
        for (const long di : {0L, 1L}) {
            const auto& texel = image.texels[static_cast<std::size_t>(within(j + dj, height, repeat_y) * width +
                                                                      within(i + di, width, repeat_x))];
            const Real weight = (di == 1 ? fx : Real(Real(1) - fx)) * (dj == 1 ? fy : Real(Real(1) - fy));
            for (std::size_t k = 0; k < 3; k++) sum[k] = sum[k] + weight * Real(texel[k]);
        }
    }
    return sum;
}

template <class Real>
struct Uv {
    Real u, v;
};

/// The angles of a direction in a frame: u once around, v from the pole.
template <class Real>
Uv<Real> angles(const Mat<Real>& frame, const Vec<Real>& direction)
{
    const Vec<Real> d = frame * unit(direction);
    Real phi = atan2(d.y, d.x);
    if (phi < -pi<Real>() / Real(2)) phi += Real(2) * pi<Real>();
    const Real theta = acos(larger(Real(-1), smaller(Real(1), d.z)));
    return {(phi + pi<Real>() / Real(2)) / (Real(2) * pi<Real>()), theta / pi<Real>()};
}

template <class Real>
Rgb<Real> photograph_at(const Texture<Real>& t, const Vec<Real>& p, const Vec<Real>& normal)
{
    Uv<Real> at{};
    if (std::holds_alternative<scene::Directional>(t.mapping)) {
        at = angles(t.frame, normal);
        at = {fraction(Real(at.u / t.size)), fraction(Real(at.v / t.size))};
    } else if (std::holds_alternative<scene::Relative>(t.mapping)) {
        at = angles(t.frame, p - t.origin);
        at = {fraction(Real(at.u / t.size)), fraction(Real(at.v / t.size))};
    } else if (std::holds_alternative<scene::Positional>(t.mapping)) {
        at = {fraction(Real(dot(t.frame.x, p) / t.size)), fraction(Real(dot(t.frame.y, p) / t.size))};
    } else if (std::holds_alternative<scene::Linear>(t.mapping)) {
        const Vec<Real> d = t.frame * (p - t.origin);
        at = {(atan2(d.y, d.x) + pi<Real>()) / (Real(2) * pi<Real>()), fraction(Real(d.z / t.size))};
    } else {
        const Vec<Real> d = p - t.origin;
        at = {fraction(Real(dot(t.across, d) + t.wrap_x)), fraction(Real(dot(t.down, d) + t.wrap_y))};
        return look_up(*t.image, Real(at.u * Real(t.image->width)), Real(at.v * Real(t.image->height)), true, true);
    }
    at = {at.u + t.wrap_x, at.v + t.wrap_y};
    if (at.u >= 1) at.u -= Real(1);
    if (at.v >= 1) at.v -= Real(1);
    // A wrap below 0 may lead outside, where the edge goes on; within, the photograph has itself for a neighbour.
    return look_up(*t.image, Real(at.u * Real(t.image->width)), Real(at.v * Real(t.image->height)), at.u >= 0,
                   at.v >= 0);
}

/// One turn around the horizon of hue h, in 0..1.
template <class Real>
Rgb<Real> hsv_to_rgb(const Real& h, const Real& s, const Real& v)
{
    const auto channel = [&](int offset) {
        Real k = h * Real(6) + Real(offset);
        if (k >= 6) k -= Real(6);
        const Real ramp = larger(Real(0), smaller(Real(1), smaller(k, Real(Real(4) - k))));
        return Real(v - v * s * ramp);
    };
    return {channel(5), channel(3), channel(1)};
}

template <class Real>
Rgb<Real> sky_in(const Sky<Real>& sky, const Vec<Real>& d)
{
    if (std::holds_alternative<scene::SkyColor>(sky.kind)) return sky.low;
    if (std::holds_alternative<scene::SkyGradient>(sky.kind)) {
        const Real t = dot(d, sky.up);
        const Rgb<Real>& end = t < 0 ? sky.low : sky.high;
        const Real k = fabs(t);
        Rgb<Real> c;
        for (std::size_t i = 0; i < 3; i++) c[i] = sky.middle[i] + (end[i] - sky.middle[i]) * k;
        return c;
    }
    if (std::holds_alternative<scene::SkyRgb>(sky.kind))
        return {(d.x + Real(1)) / Real(2), (d.y + Real(1)) / Real(2), (Real(1) - d.z) / Real(2)};
    const Uv<Real> at = angles(Mat<Real>{}, d);
    if (std::holds_alternative<scene::SkyHsv>(sky.kind)) {
        return hsv_to_rgb(at.u, smaller(Real(1), Real(Real(2) * at.v)),
                          smaller(Real(1), Real(Real(2) * (Real(1) - at.v))));
    }
    // Seen from inside: u = 0 is the last column.
    const Real x = smaller(Real((Real(1) - at.u) * Real(sky.image->width)), Real(sky.image->width - 1e-9));
    const Real y = smaller(Real(at.v * Real(sky.image->height)), Real(sky.image->height - 1e-9));
    return look_up(*sky.image, x, y, true, false);
}

/// How much a surface gives back of a light at a cosine and a distance, before its absorption filter.
template <class Real>
Real diffuse(scene::LightLaw law, const Real& cosine, const Real& distance)
{
    switch (law) {
    case scene::LightLaw::paper: return Real(2) * acos(Real(1) - cosine) / pi<Real>();
    case scene::LightLaw::lambert: return cosine;
    case scene::LightLaw::inverse_square: return cosine / (distance * distance);
    }
    return 0;
}

} // namespace clucida::oracle
