// Single crossings where they are hardest: grazing rays, and rays that start on a surface at any angle.
#include "native_oracle.h"

namespace clucida::test {
namespace {

using scene::cross;

template <typename P>
class KernelsRoots : public ::testing::Test {
};
TYPED_TEST_SUITE(KernelsRoots, Machines, MachineNames);

/// How far inside the ball's rim a line passes, in 2^-23 of its radius (float) or 2^-52 (double): r^2 |d|^2 - |k|^2.
template <typename P>
double steps_inside(const Primitive<typename P::Wide>& ball, Vec3 o, Vec3 d)
{
    using W = typename P::Wide;
    const Wide3<W> x = ball.local(widen<W>(o)), v = widen<W>(d);
    const Wide3<W> k{x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]};
    const W discriminant = -ball.w * dot(v, v) - dot(k, k);
    return static_cast<double>(discriminant / (-ball.w) / (4 * W(P::u)));
}

/// Rays aimed at the ball's rim from everywhere: the kernel's answer must be right beyond four steps, which are 16u of
/// the discriminant.
template <typename P>
void check_rim(Vec3 center, double radius)
{
    using W = typename P::Wide;
    const Native scene(scene_of({sphere(center, radius)}));
    const Primitive<W> ball = leaf_of<W>(scene, 0).members[0];
    Random random(1);
    Stats stats{};
    std::vector<Query> queries;
    std::vector<double> steps;
    while (queries.size() < 40000) {
        const double distance = log_uniform(random, 1.01, 1e6);
        const Vec3 away = random_direction(random), side = scene::unit(cross(away, random_direction(random)));
        const double off = uniform(random, -64, 64) * 2 * P::u;
        // The tangent's foot: from there on the line is at right angles to the radius.
        const double sine = 1 / distance;
        const Vec3 foot = (away * sine + side * std::sqrt(1 - sine * sine)) * (radius * (1 + off));
        const Vec3 o = to_real<P>(center + away * (distance * radius));
        const auto d = exact_direction<P>(center + foot - o);
        if (!d) continue;
        const double k = steps_inside<P>(ball, o, *d);
        if (std::fabs(k) > 64) continue;
        queries.push_back({{o, *d}});
        steps.push_back(k);
    }
    const Hits hits = P::surfaces(scene, queries, stats);
    unsigned wrong = 0, judged = 0;
    for (std::size_t i = 0; i < hits.size(); i++) {
        if (std::fabs(steps[i]) <= 4) continue;
        judged++;
        if (hits[i].has_value() != (steps[i] > 0) && wrong++ < 3)
            ADD_FAILURE() << (steps[i] > 0 ? "missed " : "invented ") << steps[i] << " steps inside, from "
                          << scene::length(queries[i].path.o - center) / radius << " radii away";
    }
    EXPECT_EQ(wrong, 0U) << "of " << judged;
    EXPECT_GT(judged, 5000U);
    expect_sound(stats);
}

TYPED_TEST(KernelsRoots, ABallIsHitOrMissedRightBeyondFourStepsFromItsRim)
{
    check_rim<TypeParam>({0, 0, 0}, 1);
}
TYPED_TEST(KernelsRoots, ABallOfAnotherSizeIsHitOrMissedRightBeyondFourStepsFromItsRim)
{
    check_rim<TypeParam>({0, 0, 0}, to_real<Float>(.7));
}

TYPED_TEST(KernelsRoots, ABallBesideTheEyeIsHitOrMissedRightBeyondFourStepsFromItsRim)
{
    check_rim<TypeParam>({.4375, -.3125, .1875}, 1);
}

/// What a ray that starts on a surface must meet: the deflated root of that surface, or nothing (0).
template <typename W>
struct Chord {
    W length;
    W actual;      ///< where the line meets the surface again, the start being a little off it
    double cosine; ///< the lesser of its ends'
    bool near;     ///< from where the solid is seen from the ray's own origin (LayoutObject::near)
};

/// Of a t^2 + 2 b t + c the root that is nearer to -2 b/a.
template <typename W>
W farther_root(const Parabola<W>& p)
{
    const W other = -2 * p.b / p.a, square = p.b * p.b - p.a * p.c;
    if (square < 0) return other;
    const W s = p.b < 0 ? root(square) - p.b : -root(square) - p.b;
    return magnitude(s / p.a - other) < magnitude(p.c / s - other) ? s / p.a : p.c / s;
}

/// Rays that start on the only surface of a solid, at cosines down to a millionth: the other crossing, if it lies
/// ahead, at -2 B/A of the floats that the ray is made of, and never the surface itself.
template <typename P>
void check_deflated(const SolidPtr& solid)
{
    using W = typename P::Wide;
    const Native scene(scene_of({solid}));
    const Leaf<W> leaf = leaf_of<W>(scene, 0);
    const Primitive<W>& q = leaf.members[0];
    const LayoutObject& object = scene.items<LayoutObject>(BUFFER_OBJECTS)[0];
    const double near = object.near, about = near > 0 ? near : 1; // a cone is always seen from elsewhere
    const Vec3 center{object.center[0], object.center[1], object.center[2]};
    Random random(3);
    Stats stats{};
    std::vector<Query> first, queries;
    while (first.size() < 20000) {
        const Vec3 o = to_real<P>(random_direction(random) * 4);
        first.push_back({{o, scene::unit(center + random_in_box(random, about * .75) - o)}});
        if (leaf.holds(widen<W>(o))) first.back().inside.push_back(0);
    }
    std::vector<Chord<W>> chords;
    for (const auto& hit : P::surfaces(scene, first, stats)) {
        if (!hit) continue;
        const double cosine = log_uniform(random, 1e-6, 1);
        const bool inward = random() % 2 != 0;
        const Vec3 side = scene::unit(cross(hit->n, random_direction(random)));
        const auto d = exact_direction<P>(side * std::sqrt(1 - cosine * cosine) + hit->n * (inward ? -cosine : cosine));
        if (!d) continue;
        const Parabola<W> p = q.parabola(widen<W>(hit->p), widen<W>(*d));
        if ((p.b < 0) != inward) continue; // the point is a unit off, the ray really leads to the other side
        const bool ahead = (p.a > 0) == inward;
        queries.push_back({{hit->p, *d, hit->left, inward}, std::vector<u32>(inward ? 1 : 0, 0U)});
        const W end = ahead ? farther_root(p) : W(0);
        const W slope = ahead ? q.slope(along(widen<W>(hit->p), widen<W>(*d), end), widen<W>(*d)) : W(1);
        chords.push_back({ahead ? -2 * p.b / p.a : W(0), end, std::min(cosine, static_cast<double>(1 / slope)),
                          scene::length(hit->p - center) < near});
    }
    const Hits hits = P::surfaces(scene, queries, stats);
    double worst = 0, far = 0;
    unsigned wrong = 0, met = 0, met_near = 0;
    for (std::size_t i = 0; i < hits.size(); i++) {
        const auto& [length, actual, cosine, is_near] = chords[i];
        if (hits[i].has_value() != (length > 0)) wrong++;
        if (!hits[i] || !(length > 0)) continue;
        const auto error = static_cast<double>(magnitude(W(hits[i]->t) - length));
        const double size = std::max(1., scene::length(queries[i].path.o)) + static_cast<double>(length);
        const auto off = static_cast<double>(magnitude(W(hits[i]->t) - actual));
        far = std::max(far, std::min(error, off) * cosine / size);
        met++;
        if (!is_near) continue;
        met_near++;
        worst = std::max(worst, error / static_cast<double>(length));
    }
    EXPECT_EQ(wrong, 0U) << "of " << hits.size();
    EXPECT_GT(met, 800U);
    EXPECT_GE(met_near, near > 0 ? 800U : 0U) << "from where the solid is seen from the ray's own origin";
    EXPECT_LE(worst / P::u, 4) << "units of the length";
    Measured("of_the_length").see(worst / P::u);
    Measured("of_the_size_where_far").see(far / P::u);
    // From farther out the chord ends where the line meets the surface, or where the start's being on it puts that.
    EXPECT_LE(far / P::u, 8) << "units of the size";
    expect_sound(stats);
}

TYPED_TEST(KernelsRoots, AChordOfABallIsExactHoweverFlat)
{
    check_deflated<TypeParam>(sphere({0, 0, 0}, 1));
}
TYPED_TEST(KernelsRoots, AChordOfABallBesideTheEyeIsExactHoweverFlat)
{
    check_deflated<TypeParam>(sphere({.4375, -.3125, .1875}, 1));
}
TYPED_TEST(KernelsRoots, AChordOfACylinderIsExactHoweverFlat)
{
    check_deflated<TypeParam>(solid(scene::Cylinder{{0, 0, 0}, {.3, .4, .5}}));
}
TYPED_TEST(KernelsRoots, AChordOfAConeIsExactHoweverFlat)
{
    check_deflated<TypeParam>(solid(scene::Cone{{0, 0, 0}, {.3, .9, -.6}}));
}
TYPED_TEST(KernelsRoots, AChordOfAParaboloidIsExactHoweverFlat)
{
    check_deflated<TypeParam>(solid(scene::Paraboloid{{0, 0, 0}, {.1, .2, .15}}));
}
TYPED_TEST(KernelsRoots, AChordOfAHyperboloidIsExactHoweverFlat)
{
    check_deflated<TypeParam>(solid(scene::Hyperboloid{{0, 0, 0}, {.4, .3, 1}, .5}));
}
TYPED_TEST(KernelsRoots, AChordOfASaddleIsExactHoweverFlat)
{
    check_deflated<TypeParam>(solid(scene::Saddle{{0, 0, 0}, {.2, .1, .7}, {1, 0, .3}}));
}
TYPED_TEST(KernelsRoots, AChordOfAnEllipsoidIsExactHoweverFlat)
{
    check_deflated<TypeParam>(solid(scene::Transformed{
        scene::Rotate{{1, 2, 3}, 40}, solid(scene::Transformed{scene::Scale{{1, .5, .75}}, sphere({0, 0, 0}, 1)})}));
}

} // namespace
} // namespace clucida::test
