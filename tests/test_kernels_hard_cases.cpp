// Cases of docs/hard-cases.md that fit no other file: scaled solids, an apex hit exactly, exact retroreflection, nested
// glass, chaos, and numbers at the ends of what a scene may hold.
#include "native_scene.h"

#include "scene/error.h"

#include <algorithm>
#include <numbers>

namespace clucida::test {
namespace {

template <typename P>
class KernelsHardCases : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsHardCases, Machines, MachineNames);

/// One of each solid, its lengths times s: a saddle's axis times 1/s, a cone's as it is.
std::vector<SolidPtr> each_solid(double s)
{
    const Vec3 c = Vec3{.25, -.125, .5} * s;
    return {plane(c, {.6, 0, .8}),
            sphere(c, s),
            solid(scene::Cylinder{c, Vec3{.3, .4, .5} * s}),
            solid(scene::Cone{c, {.3, .9, -.6}}),
            solid(scene::Paraboloid{c, Vec3{.1, .2, .15} * s}),
            solid(scene::Hyperboloid{c, Vec3{.4, .3, 1} * s, .5 * s}),
            solid(scene::Saddle{c, Vec3{.2, .1, .7} * (1 / s), {1, 0, .3}}),
            solid(scene::Cuboid{c, {.3, -.2, .9}, {1, .4, 0}, Vec3{1, 1.5, .5} * s})};
}

constexpr std::size_t cone = 3; ///< in each_solid

TYPED_TEST(KernelsHardCases, EverySolidScaledByAPowerOfTwoIsMetAtTheScaledPlaces)
{
    using P = TypeParam;
    Random random(4);
    std::vector<Query> queries;
    for (int i = 0; i < 500; i++) {
        const Vec3 o = to_real<P>(random_direction(random) * log_uniform(random, 2, 100));
        queries.push_back({{o, scene::unit(random_in_box(random, 1.25) - o)}});
    }
    Stats stats{};
    for (int k = -13; k <= 20; k++) {
        const double s = std::ldexp(1, k);
        const std::vector<SolidPtr> ones = each_solid(1), others = each_solid(s);
        std::vector<Query> scaled = queries;
        for (Query& q : scaled) q.path.o = q.path.o * s;
        for (std::size_t i = 0; i < ones.size(); i++) {
            const Hits one = P::surfaces(Native(scene_of({complement(ones[i])})), queries, stats),
                       other = P::surfaces(Native(scene_of({complement(others[i])})), scaled, stats);
            for (std::size_t r = 0; r < one.size(); r++) {
                ASSERT_EQ(one[r].has_value(), other[r].has_value()) << "solid " << i << " by 2^" << k;
                if (!one[r]) continue;
                if (i == cone) {
                    // A cone has no size: what counts as far from it is the same at every scale, and where it counts
                    // as near the ray's own length rounds.
                    const double cosine = std::fabs(scene::dot(one[r]->n, queries[r].path.d));
                    const double off = scene::length(one[r]->p * s - other[r]->p) * cosine;
                    ASSERT_LE(off, 16 * P::u * s * scene::length(queries[r].path.o)) << "by 2^" << k;
                    continue;
                }
                ASSERT_EQ(one[r]->t * s, other[r]->t) << "solid " << i << " by 2^" << k;
                ASSERT_EQ(one[r]->p * s, other[r]->p) << "solid " << i << " by 2^" << k;
                ASSERT_EQ(one[r]->n, other[r]->n) << "solid " << i << " by 2^" << k;
            }
        }
    }
}

TYPED_TEST(KernelsHardCases, AnApexHitExactlyIsPassedWithoutATrace)
{
    using P = TypeParam;
    const Native native(scene_of({solid(scene::Cone{{0, 0, 0}, {0, 0, 1}})}));
    Stats stats{};
    // Across through outside: nothing or a touch. Along the axis: from inside to inside.
    for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{.6, .8, 0}}) {
        std::vector<u32> inside;
        Path path{d * -2, d};
        int events = 0;
        while (const auto hit = next_hit<P>(native, path, inside, stats)) {
            ASSERT_TRUE(std::isfinite(hit->t + hit->n.x + hit->n.y + hit->n.z));
            EXPECT_LE(scene::length(hit->p), 4 * P::u);
            inside.assign(inside.empty() ? 1 : 0, 0U);
            path = beyond(*hit, d);
            ASSERT_LE(++events, 2);
        }
        EXPECT_TRUE(inside.empty()) << "it ends where it began, outside";
    }
    std::vector<u32> inside{0U};
    Path path{{0, 0, -2}, {0, 0, 1}};
    int events = 0;
    while (const auto hit = next_hit<P>(native, path, inside, stats)) {
        ASSERT_TRUE(std::isfinite(hit->t + hit->n.x + hit->n.y + hit->n.z));
        EXPECT_LE(scene::length(hit->p), 4 * P::u);
        inside.assign(inside.empty() ? 1 : 0, 0U);
        path = beyond(*hit, path.d);
        ASSERT_LE(++events, 2);
    }
    EXPECT_EQ(inside.size(), 1U) << "it ends where it began, inside";
    expect_sound(stats);
}

TYPED_TEST(KernelsHardCases, ACornerCubeReversesADirectionBitForBit)
{
    using P = TypeParam;
    const Native corner(
        scene_of({plane({0, 0, 0}, {1, 0, 0}), plane({0, 0, 0}, {0, 1, 0}), plane({0, 0, 0}, {0, 0, 1})}));
    Random random(17);
    Stats stats{};
    int checked = 0;
    for (int i = 0; i < 2000 / P::share; i++) {
        const Vec3 o = to_real<P>(random_in_box(random, .25) + Vec3{.75, .75, .75});
        const auto d = exact_direction<P>(random_in_box(random, .2) - o);
        if (!d || d->x >= 0 || d->y >= 0 || d->z >= 0) continue;
        Path path{o, *d};
        for (int k = 0; k < 3; k++) {
            const auto hit = next_hit<P>(corner, path, {}, stats);
            ASSERT_TRUE(hit);
            path = back(*hit, P::bend(path.d, facing(*hit, path.d), 1).reflected);
        }
        ASSERT_EQ(path.d, -*d);
        checked++;
    }
    EXPECT_GT(checked, 800 / P::share);
    expect_sound(stats);
}

TYPED_TEST(KernelsHardCases, FromTheMiddleOfNestedGlassTheSkyIsWhereItIs)
{
    using P = TypeParam;
    Scene scene = empty_scene();
    scene.sky = scene::SkyRgb{};
    View view;
    view.width = view.height = 32;
    const Image bare = render<P>(scene, view);
    // Every ray from the centre meets every ball head-on, whatever the indices; two balls have one surface in common.
    const double radii[]{.5, 1, 1, 3}, indices[]{1.5, 2.4, 1.2, 1.33};
    for (int i = 0; i < 4; i++) add(scene, sphere({0, 0, 0}, radii[i]), clear(indices[i]));
    const Image nested = render<P>(scene, view);
    EXPECT_LE(rmse(bare, nested), 4 * Float::u);
    EXPECT_EQ(nested.stats[STAT_REFRACTED], 3U * 32 * 32);
    expect_sound(nested.stats);
}

TYPED_TEST(KernelsHardCases, AtBrewstersAngleNothingOfTheParallelLightIsReflected)
{
    using P = TypeParam;
    const double n = 1.5, s = 1 / std::sqrt(1 + n * n); // tan = n
    const double half_perpendicular = std::pow((n * n - 1) / (n * n + 1), 2) / 2;
    EXPECT_NEAR(2 * half_perpendicular, .1479289941, 5e-11);
    const Bend bend = P::bend(to_real<P>(Vec3{n * s, 0, -s}), {0, 0, 1}, 1 / n);
    ASSERT_TRUE(bend.passes);
    // R is half of R_p + R_s. In float the sum has room for no more than a few units of R_s.
    EXPECT_NEAR(bend.reflectance, half_perpendicular, std::max(.5e-12, 8 * P::u * half_perpendicular));
}

// The oracle of three mirror balls, which shares nothing with the kernels: textbook formulas in 113 bits.
using Quad3 = std::array<Quad, 3>;
Quad dot(const Quad3& a, const Quad3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Quad3 quads(Vec3 v)
{
    return {v.x, v.y, v.z};
}

struct Mirrors {
    std::vector<Quad3> centers;
    /// Moves the ray to its next ball and reflects it there; -1 if it meets none.
    int bounce(Quad3& o, Quad3& d, int left) const
    {
        int next = -1;
        Quad nearest = 0;
        for (int i = 0; i < static_cast<int>(centers.size()); i++) {
            if (i == left) continue; // from outside a ball is not met again
            const Quad3& c = centers[static_cast<std::size_t>(i)];
            const Quad3 m{o[0] - c[0], o[1] - c[1], o[2] - c[2]};
            const Quad a = dot(d, d), b = dot(m, d), discriminant = b * b - a * (dot(m, m) - 1);
            if (discriminant <= 0 || b >= 0) continue;
            const Quad t = (-b - root(discriminant)) / a;
            if (next >= 0 && t >= nearest) continue;
            next = i;
            nearest = t;
        }
        if (next < 0) return next;
        Quad3 n;
        for (std::size_t k = 0; k < 3; k++) {
            o[k] += nearest * d[k];
            n[k] = o[k] - centers[static_cast<std::size_t>(next)][k];
        }
        const Quad twice = 2 * dot(d, n) / dot(n, n);
        for (std::size_t k = 0; k < 3; k++) d[k] -= twice * n[k];
        return next;
    }
};

/// To which bounce each ray's path is the oracle's: the same ball, the place to a thousandth of a radius.
TYPED_TEST(KernelsHardCases, AmongThreeMirrorBallsAPathIsTheOraclesForAtLeastSixBounces)
{
    using P = TypeParam;
    const std::vector<Vec3> centers{{1.25, 0, 0}, {-1.25, 0, 0}, {0, 2.25, 0}};
    const Native balls(scene_of({sphere(centers[0], 1), sphere(centers[1], 1), sphere(centers[2], 1)}));
    const Mirrors oracle{{quads(centers[0]), quads(centers[1]), quads(centers[2])}};
    struct Ray {
        Query query;
        Quad3 o, d;
        int left = -1, bounces = 0;
    };
    std::vector<Ray> going;
    Random random(30);
    while (going.size() < 20000) { // in the plane of the centers, where they stay longest
        const Vec3 o{0, .875, 0};
        const double angle = uniform(random, -std::numbers::pi, std::numbers::pi);
        const auto d = exact_direction<P>({std::cos(angle), std::sin(angle), 0});
        if (d) going.push_back({{{o, *d}}, quads(o), quads(*d)});
    }
    Stats stats{};
    std::vector<int> parted; // after how many bounces, of those that part at all
    int most = 0;
    while (!going.empty()) {
        std::vector<Query> queries;
        for (const Ray& ray : going) queries.push_back(ray.query);
        const Hits hits = P::surfaces(balls, queries, stats);
        std::vector<Ray> next;
        for (std::size_t i = 0; i < hits.size(); i++) {
            Ray ray = going[i];
            const int met = oracle.bounce(ray.o, ray.d, ray.left);
            most = std::max(most, ray.bounces);
            if (!hits[i] && met < 0) continue;
            const Vec3 at{static_cast<double>(ray.o[0]), static_cast<double>(ray.o[1]), static_cast<double>(ray.o[2])};
            if (!hits[i] || static_cast<int>(hits[i]->object) != met || scene::length(hits[i]->p - at) > 1e-3) {
                parted.push_back(ray.bounces);
                continue;
            }
            ray.query.path = back(*hits[i], mirrored<P>(ray.query.path.d, hits[i]->n));
            ray.left = met;
            ray.bounces++;
            next.push_back(ray);
        }
        going = std::move(next);
    }
    std::ranges::sort(parted);
    const int least = parted.empty() ? most : parted.front();
    this->RecordProperty("rays_that_part", static_cast<int>(parted.size()));
    this->RecordProperty("least_bounces_before_parting", least);
    this->RecordProperty("most_bounces_in_agreement", most);
    if (std::is_same_v<typename P::real, float>) {
        EXPECT_GE(least, 6);
        EXPECT_GE(most, 12);
        EXPECT_LE(parted.size(), 200U) << "of 20000 rays";
    } else {
        EXPECT_GE(most, 15);
        EXPECT_TRUE(parted.empty()) << parted.size() << " of 20000 rays, the first after " << least;
    }
    expect_sound(stats);
}

TYPED_TEST(KernelsHardCases, SizesAtTheEndsOfWhatASceneMayHoldGiveNoNaN)
{
    using P = TypeParam;
    View view;
    view.width = view.height = 8;
    for (const double size : {1e-37, 1e-30, 1e-20, 1e-10, 1e10, 1e18, 1e30, 1e37}) {
        for (const SolidPtr& s : each_solid(size)) {
            for (const SolidPtr& whole : {s, complement(s)}) {
                Scene scene = empty_scene();
                scene.sky = scene::SkyRgb{};
                Optics glass = clear(1.5);
                glass.reflection = {.5, .5, .5};
                glass.absorption = {1, 1, 1};
                glass.fresnel = true;
                scene.lights.push_back({{3, -1, 2}, {1, 1, 1}, {}});
                try {
                    add(scene, whole, glass);
                    const Image image = render<P>(scene, view);
                    EXPECT_EQ(image.stats[STAT_NAN], 0U) << "at a size of " << size;
                } catch (const scene::Error&) { // refused by name, which is as good
                }
            }
        }
    }
}

/// The rim of a ball of radius r: a ray from o along d meets it after `ahead`, at that slope (1/cos of the incidence).
Vec3 center_behind_rim(Vec3 o, Vec3 d, Vec3 aside, double r, double ahead, double slope)
{
    return o + d * (ahead + r / slope) + aside * (r * std::sqrt(1 - 1 / (slope * slope)));
}

TYPED_TEST(KernelsHardCases, ASmallBallThatARayHardlyCutsIsNotMetBeforeItsRim)
{
    // The balls are small beside what the rays' starts are rounded by: by the slope alone, a fifth of a radius before
    // the rim would count as on it.
    using P = TypeParam;
    constexpr double r = 1.5e-3;
    Random random(5);
    Stats stats{};
    int met = 0;
    for (int i = 0; i < 40000 / P::share; i++) {
        const Vec3 a = Vec3{0, 4, 0} + random_in_box(random, 1);
        const auto first = next_hit<P>(Native(scene_of({sphere(a, r)})), {{}, scene::unit(a)}, {}, stats);
        ASSERT_TRUE(first);
        const Vec3 side = random_direction(random), d = scene::unit(first->n + side * uniform(random));
        const Vec3 aside = scene::unit(scene::cross(d, random_direction(random)));
        const Vec3 b =
            center_behind_rim(first->p, d, aside, r, log_uniform(random, 1e-6, 3e-4), log_uniform(random, 10, 1000));
        const bool cut = i % 2 == 0;
        const SolidPtr ball = sphere(b, r);
        const Native both(scene_of({sphere(a, r), cut ? solid(scene::Intersection{{ball, plane(b, d)}}) : ball}));
        const Path path = back(*first, d);
        const auto hit = next_hit<P>(both, path, {}, stats);
        if (!hit || hit->object != 1) continue;
        met++;
        const Vec3 way = hit->p - path.o;
        EXPECT_LE(scene::length(way - d * scene::dot(way, d)), hit->err) << "it lies on the ray";
        next_hit<P>(both, back(*hit, mirrored<P>(d, facing(*hit, d))), {}, stats);
    }
    EXPECT_GT(met, 20000 / P::share);
    EXPECT_EQ(stats[STAT_PARITY], 0U);
}

} // namespace
} // namespace clucida::test
