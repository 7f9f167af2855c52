/// The scene's other things, and the whole world.
#pragma once

#include "bench/oracle/build_solids.h"
#include "bench/oracle/oracle.h"

#include <stdexcept>

namespace clucida::oracle {

template <class Real>
Rgb<Real> rgb(const scene::Rgb& c)
{
    return {Real(c.r), Real(c.g), Real(c.b)};
}

/// A filter as the kernels store it: square roots in 11, 11 and 10 bits.
inline scene::Rgb stored(const scene::Rgb& c)
{
    const auto channel = [](double v, double top) {
        const double n = std::nearbyint(std::sqrt(v) * top) / top;
        return n * n;
    };
    return {channel(c.r, 2047), channel(c.g, 2047), channel(c.b, 1023)};
}

/// The original program's rank of a medium: what it lets through in bytes, decoded as sRGB.
inline double rank_of(const scene::Optics& o)
{
    const auto decoded = [](double v) {
        const double byte = std::round(v * 255) / 255;
        return byte <= 0.04045 ? byte / 12.92 : std::pow((byte + 0.055) / 1.055, 2.4);
    };
    return decoded(o.refraction.r) + decoded(o.refraction.g) + decoded(o.refraction.b) + decoded(o.passthrough.r) +
           decoded(o.passthrough.g) + decoded(o.passthrough.b);
}

template <class Real>
Optics<Real> make_optics(const scene::Optics& o, bool as_stored, const Disturber<Real>& disturb)
{
    const auto filter = [&](const scene::Rgb& c) { return rgb<Real>(as_stored ? stored(c) : c); };
    Optics<Real> r;
    r.reflection = filter(o.reflection);
    r.absorption = filter(o.absorption);
    r.refraction = filter(o.refraction);
    r.index = disturb(Real(o.index));
    r.fresnel = o.fresnel;
    r.rank = rank_of(o);
    const Rgb<Real> passthrough = rgb<Real>(o.passthrough);
    for (std::size_t i = 0; i < 3; i++) {
        r.clear[i] = passthrough[i] == 1;
        r.blocked[i] = passthrough[i] == 0;
        if (r.blocked[i]) continue;
        const Real extinction = -log(passthrough[i]);
        r.extinction[i] = as_stored ? Real(static_cast<float>(to_double(extinction))) : extinction;
    }
    return r;
}

template <class Real>
Texture<Real> make_texture(const scene::Texture& t, bool as_stored)
{
    const auto filter = [&](const scene::Rgb& c) { return rgb<Real>(as_stored ? stored(c) : c); };
    Texture<Real> r;
    r.image = load_image(t.photograph);
    r.mapping = t.mapping;
    std::visit(
        [&](const auto& m) {
            using Mapping = std::decay_t<decltype(m)>;
            if constexpr (!std::is_same_v<Mapping, scene::Directional> && !std::is_same_v<Mapping, scene::Positional>)
                r.origin = vec<Real>(m.origin);
            if constexpr (std::is_same_v<Mapping, scene::Planar>) {
                // The dual basis of u and v in their plane: p = origin + u U + v V gives back u and v.
                const Vec<Real> u = vec<Real>(m.u), v = vec<Real>(m.v), n = cross(u, v);
                const Real size = dot(n, n);
                r.across = cross(v, n) * (Real(1) / size);
                r.down = cross(n, u) * (Real(1) / size);
            } else {
                r.frame = pole_frame(vec<Real>(m.n));
                r.size = length(vec<Real>(m.n));
            }
        },
        t.mapping);
    r.wrap_x = t.wrap_x;
    r.wrap_y = t.wrap_y;
    r.reflection = filter(t.reflection);
    r.absorption = filter(t.absorption);
    r.refraction = filter(t.refraction);
    return r;
}

template <class Real>
Sky<Real> make_sky(const decltype(scene::Scene::sky)& sky)
{
    Sky<Real> r;
    r.kind = sky;
    if (const auto* color = std::get_if<scene::SkyColor>(&sky)) r.low = rgb<Real>(color->color);
    if (const auto* gradient = std::get_if<scene::SkyGradient>(&sky)) {
        r.up = unit(vec<Real>(gradient->up));
        r.low = rgb<Real>(gradient->low);
        r.middle = rgb<Real>(gradient->middle);
        r.high = rgb<Real>(gradient->high);
    }
    if (const auto* photograph = std::get_if<scene::SkyPhotograph>(&sky)) r.image = load_image(photograph->photograph);
    return r;
}

template <class Real>
Observer<Real> make_observer(const scene::Pinhole& o, const Real& aspect)
{
    Observer<Real> r;
    const Real height = Real(2) * tan(Real(Real(o.fov) * pi<Real>() / Real(360)));
    r.eye = vec<Real>(o.eye);
    r.forward = unit(vec<Real>(o.look) - r.eye);
    const Vec<Real> right = unit(cross(r.forward, vec<Real>(o.up)));
    r.column = right * (height * aspect);
    r.row = cross(r.forward, right) * height;
    return r;
}

template <class Real>
Observer<Real> make_observer(const scene::Window& o, const Real& aspect)
{
    Observer<Real> r;
    r.eye = vec<Real>(o.eye);
    r.forward = vec<Real>(o.view) - r.eye;
    r.column = vec<Real>(o.column) * aspect;
    r.row = vec<Real>(o.row);
    r.window = true;
    return r;
}

template <class Real>
World<Real> build(const scene::Scene& scene, const Options& options)
{
    if (options.view.as_original != scene::AsOriginal::none)
        throw std::invalid_argument("the oracle does not imitate the original program");
    World<Real> world;
    world.width = options.view.width;
    world.height = options.view.height;
    world.max_hops = options.view.max_hops.value_or(scene.settings.max_hops);
    world.light_law = scene.settings.light_law;
    world.media_rule = scene.settings.media_rule;
    world.disturbance = options.disturbance;
    const Real aspect = Real(world.width) / Real(world.height);
    world.observer = std::visit([&](const auto& o) { return make_observer(o, aspect); }, scene.observer);
    Disturber<Real> disturb{options.disturbance, world.observer.eye};
    world.cutoff = disturb(Real(options.view.cutoff.value_or(scene.settings.cutoff)));

    for (const scene::Optics& o : scene.optics)
        world.optics.push_back(make_optics<Real>(o, options.stored_colors, disturb));
    for (const scene::Texture& t : scene.textures)
        world.textures.push_back(make_texture<Real>(t, options.stored_colors));
    for (const scene::Light& l : scene.lights)
        world.lights.push_back({disturb.point(vec<Real>(l.point)), rgb<Real>(l.color)});
    world.sky = make_sky<Real>(scene.sky);
    for (const scene::Object& o : scene.objects) {
        Object<Real> object;
        disturb.object++;
        SolidBuilder<Real>(disturb, object).build(*o.solid);
        object.optics = static_cast<std::uint32_t>(o.optics);
        if (o.texture) object.texture = static_cast<std::uint32_t>(*o.texture);
        world.objects.push_back(std::move(object));
    }
    return world;
}

} // namespace clucida::oracle
