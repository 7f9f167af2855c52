// The core natively, as C.
#include "machines.h"

namespace clucida::test {
namespace {

NativeRay ray_of(const Path& path)
{
    return {{path.o.x, path.o.y, path.o.z}, {path.d.x, path.d.y, path.d.z}, path.left, path.left_inside, path.err};
}

/// The functions of one precision.
template <typename Real>
struct Core;
template <>
struct Core<float> {
    static constexpr auto surface = native_surface_f;
    static constexpr auto surfaces = native_surfaces_f;
    static constexpr auto surface_full = native_surface_full_f;
    static constexpr auto render_packets = native_render_packets_f;
    static constexpr auto trace = native_trace_f;
    static constexpr auto render = native_render_f;
    static constexpr auto refract = native_refract_f;
    static constexpr auto reflect = native_reflect_f;
    static constexpr auto diffuse = native_diffuse_f;
    static constexpr auto unpack_filter = native_unpack_filter_f;
};
template <>
struct Core<double> {
    static constexpr auto surface = native_surface_d;
    static constexpr auto surfaces = native_surfaces_d;
    static constexpr auto surface_full = native_surface_full_d;
    static constexpr auto render_packets = native_render_packets_d;
    static constexpr auto trace = native_trace_d;
    static constexpr auto render = native_render_d;
    static constexpr auto refract = native_refract_d;
    static constexpr auto reflect = native_reflect_d;
    static constexpr auto diffuse = native_diffuse_d;
    static constexpr auto unpack_filter = native_unpack_filter_d;
};

Hit hit_of(const NativeSurface& s)
{
    return Hit{s.t,
               {s.p[0], s.p[1], s.p[2]},
               {s.n[0], s.n[1], s.n[2]},
               s.object,
               s.before,
               s.after,
               s.left,
               s.beyond_inside != 0,
               s.err};
}

} // namespace

Native::Native(const scene::Scene& scene, const scene::View& view) : compiled(scene::compile(scene, view))
{
    for (std::size_t i = 0; i < BUFFER_COUNT; i++) buffers.buffers[i] = compiled.buffers.bytes[i].data();
}

template <typename Real>
Hits NativeCore<Real>::surfaces(const Native& scene, std::span<const Query> queries, Stats& stats)
{
    Hits hits;
    for (const Query& q : queries) {
        const NativeRay ray = ray_of(q.path);
        NativeSurface s{};
        if (Core<Real>::surface(&scene.buffers, &ray, q.inside.data(), static_cast<u32>(q.inside.size()), &s,
                                stats.data()) == 0)
            hits.push_back(std::nullopt);
        else
            hits.push_back(hit_of(s));
    }
    return hits;
}

template <typename Real>
std::vector<Rgb> NativeCore<Real>::traces(const Native& scene, std::span<const Path> paths, Stats& stats)
{
    std::vector<Rgb> colors;
    for (const Path& path : paths) {
        const NativeRay ray = ray_of(path);
        double rgb[3];
        Core<Real>::trace(&scene.buffers, &ray, rgb, stats.data());
        colors.push_back({rgb[0], rgb[1], rgb[2]});
    }
    return colors;
}

template <typename Real>
void NativeCore<Real>::render(const Native& scene, const scene::View& view, float* rgba, Stats& stats)
{
    Core<Real>::render(&scene.buffers, 0, 0, view.width, view.height, 0, view.samples, rgba, stats.data());
}

template <typename Real>
Bend NativeCore<Real>::bend(Vec3 d, Vec3 n, double w)
{
    const double from[3]{d.x, d.y, d.z}, normal[3]{n.x, n.y, n.z};
    double out[3];
    Bend bend;
    bend.passes = Core<Real>::refract(from, normal, w, out, &bend.reflectance) != 0;
    if (bend.passes) bend.refracted = {out[0], out[1], out[2]};
    Core<Real>::reflect(from, normal, out);
    bend.reflected = {out[0], out[1], out[2]};
    return bend;
}

template <typename Real>
double NativeCore<Real>::diffuse(u32 law, double cosine, double distance)
{
    return Core<Real>::diffuse(law, cosine, distance);
}

template <typename Real>
Rgb NativeCore<Real>::unpack_filter(u32 packed)
{
    double out[3];
    Core<Real>::unpack_filter(packed, out);
    return {out[0], out[1], out[2]};
}

template <typename Real>
Hits PacketCore<Real>::surfaces(const Native& scene, std::span<const Query> queries, Stats& stats)
{
    constexpr std::size_t lanes = 8;
    Hits hits;
    for (std::size_t begin = 0; begin < queries.size(); begin += lanes) {
        const auto some = queries.subspan(begin, std::min(lanes, queries.size() - begin));
        std::array<NativeRay, lanes> rays{};
        std::array<u32, lanes> media{};
        std::array<NativeSurface, lanes> surfaces{};
        std::array<int, lanes> found{};
        media.fill(NO_RAY);
        for (std::size_t i = 0; i < some.size(); i++) {
            rays[i] = ray_of(some[i].path);
            media[i] = some[i].inside.empty() ? vacuum : some[i].inside.front();
        }
        Core<Real>::surfaces(&scene.buffers, rays.data(), media.data(), surfaces.data(), found.data());
        for (std::size_t i = 0; i < some.size(); i++) {
            if (found[i] < 0)
                found[i] = Core<Real>::surface_full(&scene.buffers, &rays[i], media[i], &surfaces[i], stats.data());
            hits.push_back(found[i] ? std::optional(hit_of(surfaces[i])) : std::nullopt);
        }
    }
    return hits;
}

template <typename Real>
void PacketCore<Real>::render(const Native& scene, const scene::View& view, float* rgba, Stats& stats)
{
    Core<Real>::render_packets(&scene.buffers, 0, 0, view.width, view.height, 0, view.samples, rgba, stats.data());
}

template struct PacketCore<float>;
template struct PacketCore<double>;
template struct NativeCore<float>;
template struct NativeCore<double>;

} // namespace clucida::test
