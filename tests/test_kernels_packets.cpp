// The kernel of packets may only say what the full search, and the kernel of single rays, would have said.
#include "host/scene_source.h"
#include "native_scene.h"

#include <filesystem>

namespace clucida::test {
namespace {

constexpr std::size_t lanes = 8;

struct Shipped {
    std::string name;
    scene::Compiled compiled;
    NativeScene native{};
    const LayoutFrame& frame() const
    {
        return *reinterpret_cast<const LayoutFrame*>(compiled.buffers.bytes[BUFFER_FRAME].data());
    }
};

std::vector<Shipped> shipped_scenes(const View& view)
{
    std::vector<Shipped> out;
    for (const auto& entry : std::filesystem::directory_iterator(CLUCIDA_SCENES)) {
        if (entry.path().extension() != ".clu") continue;
        const host::SceneSource source = host::load_scene({entry.path().string(), "", "", false});
        Shipped s{entry.path().filename().string(), host::compile_scene(source, view), {}};
        for (std::size_t i = 0; i < BUFFER_COUNT; i++) s.native.buffers[i] = s.compiled.buffers.bytes[i].data();
        out.push_back(std::move(s));
    }
    return out;
}

/// A ray, and the medium of its start.
struct Start {
    NativeRay ray{};
    u32 medium = vacuum;
};

Vec3 vec_of(const double v[3])
{
    return {v[0], v[1], v[2]};
}

Start start_of(Vec3 o, Vec3 d)
{
    return {{{o.x, o.y, o.z}, {d.x, d.y, d.z}, MEMBER_NONE, 0, 0}, vacuum};
}

/// A ray that leaves the surface in direction d, beyond it or on the side that it was met from.
Start leaving(const NativeSurface& s, Vec3 d, bool beyond)
{
    return {{{s.p[0], s.p[1], s.p[2]}, {d.x, d.y, d.z}, s.left, (s.beyond_inside != 0) == beyond, s.err},
            beyond ? s.after : s.before};
}

/// Directions through the picture, at random, from where the observer is.
std::vector<Start> observed(const Shipped& scene, std::size_t count, Random& random)
{
    const LayoutFrame& f = scene.frame();
    std::vector<Start> out;
    for (std::size_t i = 0; i < count; i++) {
        const double u = uniform(random, -0.5, 0.5), v = uniform(random, -0.5, 0.5);
        Vec3 d{f.forward[0], f.forward[1], f.forward[2]};
        d = d + Vec3{f.column[0], f.column[1], f.column[2]} * u + Vec3{f.row[0], f.row[1], f.row[2]} * v;
        out.push_back(start_of({0, 0, 0}, to_real<Float>(scene::unit(d))));
    }
    return out;
}

/// err is left out: it is a bound, and a larger one where the full search has passed silent crossings.
bool same(const NativeSurface& a, const NativeSurface& b)
{
    const auto equal = [](const double x[3], const double y[3]) { return std::equal(x, x + 3, y); };
    return a.t == b.t && equal(a.p, b.p) && equal(a.n, b.n) && a.object == b.object && a.before == b.before &&
           a.after == b.after && a.left == b.left && a.beyond_inside == b.beyond_inside;
}

struct Lanes {
    std::array<NativeRay, lanes> rays{};
    std::array<u32, lanes> media{};
    std::array<NativeSurface, lanes> surfaces{};
    std::array<int, lanes> found{};
    Lanes() { media.fill(NO_RAY); }
    void search(const Shipped& scene)
    {
        native_surfaces_f(&scene.native, rays.data(), media.data(), surfaces.data(), found.data());
    }
};

struct Tally {
    std::size_t rays = 0, sure = 0;
};

/// Searches the rays as packets, and holds each that is sure against the full search. Returns what they lead to:
/// straight on, and mirrored.
std::vector<Start> follow(const Shipped& scene, std::span<const Start> starts, Tally& tally)
{
    std::vector<Start> next;
    for (std::size_t begin = 0; begin < starts.size(); begin += lanes) {
        const auto some = starts.subspan(begin, std::min(lanes, starts.size() - begin));
        Lanes packet;
        for (std::size_t i = 0; i < some.size(); i++) {
            packet.rays[i] = some[i].ray;
            packet.media[i] = some[i].medium;
        }
        packet.search(scene);
        for (std::size_t i = 0; i < lanes; i++) {
            if (i >= some.size()) {
                EXPECT_EQ(packet.found[i], 0) << scene.name << ": an empty lane met something";
                continue;
            }
            NativeSurface full{};
            Stats stats{};
            const int found = native_surface_full_f(&scene.native, &some[i].ray, some[i].medium, &full, stats.data());
            tally.rays++;
            if (packet.found[i] >= 0) {
                tally.sure++;
                EXPECT_EQ(packet.found[i], found) << scene.name;
                EXPECT_TRUE(!found || same(packet.surfaces[i], full)) << scene.name << ", object " << full.object;
            }
            if (!found) continue;
            const Vec3 d = vec_of(some[i].ray.d), n = vec_of(full.n);
            next.push_back(leaving(full, d, true));
            next.push_back(leaving(full, mirrored<Float>(d, n), false));
        }
    }
    return next;
}

TEST(KernelsPackets, WhatIsSureIsWhatTheFullSearchFinds)
{
    Random random(20161127);
    Tally all;
    for (const Shipped& scene : shipped_scenes({96, 54, 1, {}, {}, {}})) {
        Tally tally;
        std::vector<Start> starts = observed(scene, 1600, random);
        for (int hop = 0; hop < 6; hop++) {
            starts = follow(scene, starts, tally);
            std::shuffle(starts.begin(), starts.end(), random);
            starts.resize(std::min<std::size_t>(starts.size(), 4000));
        }
        // Tori are left to the full search.
        const double least = scene.name == "rings.clu" ? 0.05 : 0.85;
        EXPECT_GE(static_cast<double>(tally.sure), least * static_cast<double>(tally.rays)) << scene.name;
        all.rays += tally.rays;
        all.sure += tally.sure;
    }
    EXPECT_GT(all.rays, 200000U);
    EXPECT_GT(static_cast<double>(all.sure), 0.9 * static_cast<double>(all.rays));
}

TEST(KernelsPackets, ALaneDoesNotDependOnItsNeighbours)
{
    Random random(7);
    for (const Shipped& scene : shipped_scenes({96, 54, 1, {}, {}, {}})) {
        Tally tally;
        std::vector<Start> starts = observed(scene, 64, random);
        for (const Start& s : follow(scene, starts, tally)) starts.push_back(s);
        for (std::size_t i = 0; i + lanes <= starts.size(); i += lanes) {
            Lanes together;
            for (std::size_t k = 0; k < lanes; k++) {
                together.rays[k] = starts[i + k].ray;
                together.media[k] = starts[i + k].medium;
            }
            together.search(scene);
            const std::size_t k = random() % lanes, other = random() % lanes;
            Lanes alone;
            alone.rays[other] = starts[i + k].ray;
            alone.media[other] = starts[i + k].medium;
            alone.search(scene);
            EXPECT_EQ(alone.found[other], together.found[k]) << scene.name;
            if (alone.found[other] > 0) {
                EXPECT_TRUE(same(alone.surfaces[other], together.surfaces[k])) << scene.name;
            }
        }
    }
}

struct Drawn {
    std::vector<float> rgba;
    Stats stats{};
};

Drawn drawn(const Shipped& scene, const View& view, decltype(native_render_f)* render)
{
    Drawn out{std::vector<float>(std::size_t{4} * view.width * view.height), {}};
    for (unsigned sample = 0; sample < view.samples; sample += 16) {
        std::vector<float> part(out.rgba.size());
        render(&scene.native, 0, 0, view.width, view.height, sample, std::min(sample + 16, view.samples), part.data(),
               out.stats.data());
        for (std::size_t i = 0; i < part.size(); i++) out.rgba[i] += part[i];
    }
    return out;
}

/// As the kernel of single rays draws it: the same rays, and the same light but for the order in which it is added up:
/// a sum of n numbers is off by at most n roundings of itself.
void expect_the_same_picture(const Shipped& scene, const View& view)
{
    const Drawn packets = drawn(scene, view, native_render_packets_f), pixels = drawn(scene, view, native_render_f);
    for (const LayoutStat stat :
         {STAT_RAYS, STAT_PRIMARY, STAT_REFLECTED, STAT_REFRACTED, STAT_SHADOW, STAT_CUT_BRANCHES, STAT_HOP_BRANCHES,
          STAT_PARITY, STAT_NAN, STAT_STACK_OVERFLOW, STAT_STUCK})
        EXPECT_EQ(packets.stats[stat], pixels.stats[stat]) << scene.name << ", counter " << stat;
    EXPECT_EQ(packets.stats[STAT_PARITY], 0U) << scene.name;
    const double truncated = pixels.stats[STAT_TRUNCATED];
    EXPECT_NEAR(packets.stats[STAT_TRUNCATED], truncated, 1 + pixels.stats[STAT_CUT_BRANCHES]) << scene.name;
    const double rays = static_cast<double>(pixels.stats[STAT_RAYS]) / (view.width * view.height); // a pixel has
    for (std::size_t i = 0; i < pixels.rgba.size(); i++) {
        const double bound = Float::u * (200 + 20 * rays) * (1 + pixels.rgba[i]);
        EXPECT_NEAR(packets.rgba[i], pixels.rgba[i], bound) << scene.name << ", value " << i;
    }
}

TEST(KernelsPackets, DrawTheSamePictures)
{
    const View view{96, 54, 1, {}, {}, {}};
    for (const Shipped& scene : shipped_scenes(view)) expect_the_same_picture(scene, view);
}

TEST(KernelsPackets, DrawOddSizesSamplesAndLimits)
{
    for (View view : {View{1, 1, 1, {}, {}, {}}, View{33, 31, 1, {}, {}, {}}, View{40, 17, 20, {}, {}, {}},
                      View{48, 27, 1, 1, {}, {}}, View{48, 27, 1, 5, 0.0, {}}})
        for (const Shipped& scene : shipped_scenes(view))
            if (scene.name == "gems.clu" || scene.name == "drink.clu") expect_the_same_picture(scene, view);
}

TEST(KernelsPackets, StartWhereTheObserverIs)
{
    const std::string view =
        "observer { eye [0, 0, 0]; look [0, 1, 0]; fov 60 }\nsky gradient { low [1, 0, 0]; "
        "middle [0, 1, 0]; high [0, 0, 1] }\n"
        "optics glass { reflection 1; index 1.5; refraction 1; fresnel }\noptics stone { absorption 1 "
        "}\n";
    for (const char* about : {"object { solid sphere([0, 1, 0], 3); optics glass }",
                              "object { solid sphere([0, 1, 0], 3) - sphere([0, 0, 0], 1); optics glass }",
                              "object { solid sphere([0, 1, 0], 3); optics stone }"}) {
        const View size{40, 30, 2, {}, {}, {}};
        Shipped scene{about, scene::compile(parse(view + about), size), {}};
        for (std::size_t i = 0; i < BUFFER_COUNT; i++) scene.native.buffers[i] = scene.compiled.buffers.bytes[i].data();
        const Drawn packets = drawn(scene, size, native_render_packets_f), pixels = drawn(scene, size, native_render_f);
        EXPECT_EQ(packets.stats[STAT_RAYS], pixels.stats[STAT_RAYS]) << about;
        for (std::size_t i = 0; i < pixels.rgba.size(); i++)
            EXPECT_NEAR(packets.rgba[i], pixels.rgba[i], 1e-5) << about << ", value " << i;
    }
}

} // namespace
} // namespace clucida::test
