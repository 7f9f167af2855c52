/// The rules of docs/optics.md, read out one after the other.
#pragma once

#include "bench/oracle/light_impl.h"
#include "host/share_work.h"

namespace clucida::oracle {

/// The filters that hold at one point of a surface.
template <class Real>
struct Look {
    Rgb<Real> reflection, absorption, refraction;
    bool opaque = false, emits = false, fresnel = false;
};

/// A ray as it starts is known to rounding only. Its numbers come from sums: what rounds counts against the vector's
/// length, not against each component. key goes on with each number.
template <class Real>
Ray<Real> disturbed_ray(const World<Real>& world, const Ray<Real>& ray, std::uint64_t& key)
{
    if (!world.disturbance) return ray;
    const auto disturb = [&](const Vec<Real>& v) {
        const double size = world.disturbance->size * to_double(length(v));
        Vec<Real> out = v;
        for (Real* component : {&out.x, &out.y, &out.z})
            *component += Real(size * noise(world.disturbance->seed, key += std::uint64_t{1} << 48U));
        return out;
    };
    const Vec<Real>& eye = world.observer.eye;
    return {eye + disturb(ray.o - eye), unit(disturb(ray.d))};
}

template <class Real>
Vec<Real> vec_of(const std::array<Real, 3>& v)
{
    return {v[0], v[1], v[2]};
}
template <class Real>
std::array<Real, 3> array_of(const Vec<Real>& v)
{
    return {v.x, v.y, v.z};
}

template <class Real>
class Tracer {
public:
    /// key tells paths apart, for disturbances.
    Tracer(const World<Real>& world, Path& path, std::uint64_t key) : world_(world), path_(path), key_(key) {}

    void from(const Ray<Real>& ray)
    {
        const Rgb<Real> one{Real(1), Real(1), Real(1)};
        Rgb<Real> color{};
        trace(Line<Real>(disturbed_ray(world_, ray, key_), {{}, true}), 0, one, one, color);
        for (std::size_t i = 0; i < 3; i++) path_.rgb[i] = to_double(color[i]);
    }

    /// Of all that follows only the first segment; the rays that it leaves are not traced, but told.
    Segment<Real> first(const Branch<Real>& branch)
    {
        Segment<Real> out;
        only_ = &out;
        const Ray<Real> ray{vec_of(branch.o), unit(vec_of(branch.d))};
        Rgb<Real> color{};
        trace(Line<Real>(ray, {branch.left, branch.left.empty()}), branch.hop, branch.throughput, branch.throughput,
              color);
        if (!path_.events.empty()) out.event = path_.events.front();
        return out;
    }

private:
    static bool below(const Rgb<Real>& c, const Real& limit) { return c[0] < limit && c[1] < limit && c[2] < limit; }
    static bool black(const Rgb<Real>& c) { return c[0] == 0 && c[1] == 0 && c[2] == 0; }
    static Rgb<Real> times(const Rgb<Real>& a, const Rgb<Real>& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
    static Rgb<Real> times(const Rgb<Real>& a, const Real& b) { return {a[0] * b, a[1] * b, a[2] * b}; }

    const Optics<Real>& optics_of(std::uint32_t object) const { return world_.optics[world_.objects[object].optics]; }
    Real index_of(std::uint32_t medium) const
    {
        // An emitter has no index of its own; its magnitude serves where an observer stands in one.
        return medium == vacuum ? Real(1) : Real(fabs(optics_of(medium).index));
    }

    /// Whether nothing is left to be seen, or cutoff or hop limit end the branch, which is counted.
    bool ended(unsigned hop, const Rgb<Real>& throughput, const Rgb<Real>& weight)
    {
        if (black(throughput)) return true;
        if (hop < world_.max_hops && !below(throughput, world_.cutoff)) return false;
        path_.truncated += to_double(larger(weight[0], larger(weight[1], weight[2])));
        return true;
    }
    bool opaque(std::uint32_t medium) const { return medium != vacuum && optics_of(medium).index == 0; }

    /// Traces one branch, adds filter x what it sees to color, and says whether it was more than black at once.
    /// throughput is the product of the filters since the observer, weight that and what the media let pass.
    bool trace(const Line<Real>& line, unsigned hop, const Rgb<Real>& throughput, const Rgb<Real>& weight,
               Rgb<Real>& color)
    {
        if (ended(hop, throughput, weight)) return false;
        const auto found = Walk<Real>(world_, line).to_surface();
        if (opaque(found.before)) return false;
        const std::size_t event = path_.events.size();
        path_.events.push_back({});
        path_.events[event].hop = hop;
        if (!found.hit) {
            color = sky(line.ray.d, found.before);
            return true;
        }
        const Rgb<Real> passed = passthrough(found.before, found.hit->t);
        color = times(surface(line, *found.hit, event, throughput, times(weight, passed)), passed);
        return true;
    }

    Rgb<Real> sky(const Vec<Real>& d, std::uint32_t medium) const
    {
        Rgb<Real> c = sky_in(world_.sky, d);
        if (medium == vacuum) return c;
        for (std::size_t i = 0; i < 3; i++)
            if (!optics_of(medium).clear[i]) c[i] = 0;
        return c;
    }

    Rgb<Real> passthrough(std::uint32_t medium, const Real& distance) const
    {
        Rgb<Real> c{Real(1), Real(1), Real(1)};
        if (medium == vacuum) return c;
        const Optics<Real>& o = optics_of(medium);
        for (std::size_t i = 0; i < 3; i++) {
            if (o.blocked[i])
                c[i] = 0;
            else if (!o.clear[i])
                c[i] = exp(Real(-o.extinction[i] * distance));
        }
        return c;
    }

    /// Whose filters show: the crossed object's, unless the medium beyond is opaque or emits, or the rank rule gives
    /// the surface to the medium outside.
    std::uint32_t shown(const Hit<Real>& hit) const
    {
        const std::uint32_t outside = std::max(hit.before, hit.after);
        if (outside == vacuum || optics_of(hit.object).index < 0) return hit.object;
        if (hit.object == hit.before && optics_of(outside).index <= 0) return outside;
        if (world_.media_rule == scene::MediaRule::rank && optics_of(outside).rank < optics_of(hit.object).rank / 2)
            return outside;
        return hit.object;
    }

    Look<Real> look_at_surface(const Hit<Real>& hit) const
    {
        const std::uint32_t object = shown(hit);
        const Optics<Real>& o = optics_of(object);
        Look<Real> look{o.reflection, o.absorption, o.refraction};
        look.emits = optics_of(hit.object).index < 0 || (hit.after != vacuum && optics_of(hit.after).index < 0);
        look.opaque = hit.after != vacuum && optics_of(hit.after).index == 0;
        look.fresnel = optics_of(hit.object).fresnel && !look.opaque;
        if (const auto& texture = world_.objects[object].texture) {
            const Texture<Real>& t = world_.textures[*texture];
            const Rgb<Real> photograph = photograph_at(t, hit.point, hit.normal);
            const auto add = [&](Rgb<Real>& own, const Rgb<Real>& share) {
                for (std::size_t i = 0; i < 3; i++) own[i] = smaller(Real(1), Real(own[i] + photograph[i] * share[i]));
            };
            add(look.reflection, t.reflection);
            add(look.absorption, t.absorption);
            add(look.refraction, t.refraction);
        }
        return look;
    }

    Rgb<Real> surface(const Line<Real>& line, const Hit<Real>& hit, std::size_t event, const Rgb<Real>& throughput,
                      const Rgb<Real>& weight)
    {
        const bool entering = hit.object == hit.after;
        path_.events[event].object = hit.object;
        path_.events[event].face = hit.face;
        path_.events[event].what = entering ? what_entering : 0U;
        const Look<Real> look = look_at_surface(hit);
        if (look.emits) {
            path_.events[event].what |= what_emitted;
            return look.refraction;
        }
        const Vec<Real> n = entering ? hit.normal : -hit.normal; // on the ray's side
        const Vec<Real>& d = line.ray.d;
        const Real cosine = -dot(n, d);
        Rgb<Real> reflection = look.reflection, refraction{};
        Vec<Real> refracted;
        if (!look.opaque) {
            // Snell's law in vectors; sine2 is the squared sine beyond.
            const Real n1 = index_of(hit.before), n2 = index_of(hit.after), w = n1 / n2;
            const Real sine2 = w * w * (Real(1) - cosine * cosine);
            if (sine2 > 1) {
                path_.events[event].what |= what_total;
                for (std::size_t i = 0; i < 3; i++)
                    reflection[i] = smaller(Real(1), Real(look.reflection[i] + look.refraction[i]));
            } else {
                const Real beyond = sqrt(Real(Real(1) - sine2));
                refraction = look.refraction;
                refracted = unit(Vec<Real>(d * w + n * (w * cosine - beyond)));
                if (look.fresnel) {
                    const Real s = (n1 * cosine - n2 * beyond) / (n1 * cosine + n2 * beyond);
                    const Real p = (n1 * beyond - n2 * cosine) / (n1 * beyond + n2 * cosine);
                    const Real r = (s * s + p * p) / Real(2);
                    reflection = times(reflection, r);
                    refraction = times(refraction, Real(Real(1) - r));
                }
            }
        }
        Rgb<Real> color = hit.before == vacuum ? absorbed(hit, n, look.absorption, event) : Rgb<Real>{};
        const auto branch = [&](const Vec<Real>& direction, const Rgb<Real>& filter, What followed) {
            const unsigned hop = path_.events[event].hop + 1;
            const Rgb<Real> next_throughput = times(throughput, filter), next_weight = times(weight, filter);
            Rgb<Real> seen{};
            if (only_) {
                const Line<Real> next_line({hit.point, direction}, {hit.surfaces, false});
                if (ended(hop, next_throughput, next_weight) ||
                    opaque(Walk<Real>(world_, next_line).to_surface().before))
                    return;
                auto& told = followed == what_reflected ? only_->reflected : only_->refracted;
                told = {array_of(hit.point), array_of(direction), hit.surfaces, hop, next_throughput};
            } else {
                const Line<Real> next_line(disturbed_ray(world_, {hit.point, direction}, key_), {hit.surfaces, false});
                if (!trace(next_line, hop, next_throughput, next_weight, seen)) return;
            }
            path_.events[event].what |= followed;
            for (std::size_t i = 0; i < 3; i++) color[i] += filter[i] * seen[i];
        };
        branch(unit(Vec<Real>(d + n * (cosine + cosine))), reflection, what_reflected);
        branch(refracted, refraction, what_refracted);
        return color;
    }

    /// What the lights give.
    Rgb<Real> absorbed(const Hit<Real>& hit, const Vec<Real>& n, const Rgb<Real>& filter, std::size_t event)
    {
        Rgb<Real> sum{};
        if (black(filter)) return sum;
        for (std::size_t i = 0; i < world_.lights.size(); i++) {
            const Light<Real>& light = world_.lights[i];
            const Vec<Real> way = light.point - hit.point;
            const Real distance = length(way);
            if (!(distance > 0)) continue;
            const Ray<Real> ray{hit.point, way * (Real(1) / distance)};
            const Real cosine = smaller(Real(1), dot(n, ray.d));
            if (!(cosine > 0) || hidden(world_, Line<Real>(ray, {hit.surfaces, false}), distance)) continue;
            path_.events[event].lights |= 1U << (i % 32);
            const Real u = diffuse(world_.light_law, cosine, distance);
            for (std::size_t k = 0; k < 3; k++) sum[k] += light.color[k] * filter[k] * u;
        }
        return sum;
    }

    const World<Real>& world_;
    Path& path_;
    std::uint64_t key_;
    Segment<Real>* only_ = nullptr; ///< where the first segment is told, if it is all that is asked for
};

template <class Real>
Segment<Real> segment(const World<Real>& world, const Branch<Real>& branch)
{
    Path path;
    return Tracer<Real>(world, path, 0).first(branch);
}

template <class Real>
Branch<Real> disturbed(const World<Real>& world, const Branch<Real>& branch, std::uint64_t key)
{
    if (!world.disturbance) return branch;
    const Ray<Real> ray = disturbed_ray(world, {vec_of(branch.o), vec_of(branch.d)}, key);
    Branch<Real> out = branch;
    out.o = array_of(ray.o);
    out.d = array_of(ray.d);
    for (Real& channel : out.throughput)
        channel *= Real(1 + world.disturbance->size * noise(world.disturbance->seed, key += std::uint64_t{1} << 48U));
    return out;
}

template <class Real>
Path follow(const World<Real>& world, const std::array<Real, 3>& o, const std::array<Real, 3>& d)
{
    Path path;
    Tracer<Real>(world, path, 0).from({{o[0], o[1], o[2]}, unit(Vec<Real>{d[0], d[1], d[2]})});
    return path;
}

/// Where in its pixel a sample lies: the middle, and from there by the golden ratio's two-dimensional kin.
template <class Real>
Uv<Real> offset_of(unsigned sample)
{
    const Real step_u = Real(3242174889.0 / 4294967296.0), step_v = Real(2447445414.0 / 4294967296.0);
    return {fraction(Real(Real(0.5) + Real(sample) * step_u)), fraction(Real(Real(0.5) + Real(sample) * step_v))};
}

template <class Real>
Ray<Real> observer_ray(const World<Real>& world, unsigned x, unsigned y, unsigned sample)
{
    const Observer<Real>& eye = world.observer;
    const Uv<Real> within = offset_of<Real>(sample);
    const Real u = (Real(x) + within.u) / Real(world.width) - Real(0.5);
    const Real v = (Real(y) + within.v) / Real(world.height) - Real(0.5);
    const Vec<Real> across = eye.column * u + eye.row * v;
    return {eye.window ? eye.eye + across : eye.eye, unit(eye.forward + across)};
}

template <class Real>
Branch<Real> observer_branch(const World<Real>& world, unsigned x, unsigned y, unsigned sample)
{
    const Ray<Real> ray = observer_ray(world, x, y, sample);
    Branch<Real> out;
    out.o = array_of(ray.o);
    out.d = array_of(ray.d);
    return out;
}

template <class Real>
Path observe(const World<Real>& world, unsigned x, unsigned y, unsigned sample)
{
    const std::uint64_t key = (std::uint64_t{y} * world.width + x) * 4096 + sample % 4096;
    Path path;
    Tracer<Real>(world, path, key).from(observer_ray(world, x, y, sample));
    return path;
}

template <class Real>
std::vector<Path> render(const World<Real>& world, std::span<const Pixel> pixels, unsigned threads)
{
    std::vector<Path> paths(pixels.size());
    host::share_work(pixels.size(), threads, [&](std::size_t i, unsigned) {
        paths[i] = observe(world, pixels[i].x, pixels[i].y, pixels[i].sample);
    });
    return paths;
}

} // namespace clucida::oracle
