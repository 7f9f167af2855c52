// What holds for any solid, any ray and any scene, tried on random ones; RapidCheck shrinks what fails. The same cases
// every time, unless RC_PARAMS says otherwise: RC_PARAMS="seed=7 max_success=100000" test_properties
#include "property_generators.h"
#include "property_oracle.h"

#include "scene/read.h"

#include <cstdlib>
#include <rapidcheck/gtest.h>

namespace clucida::test {
namespace {

void assert_sound(const Stats& stats)
{
    RC_ASSERT(stats[STAT_PARITY] == 0U);
    RC_ASSERT(stats[STAT_NAN] == 0U);
    RC_ASSERT(stats[STAT_INTERIOR_OVERFLOW] == 0U);
    RC_ASSERT(stats[STAT_STACK_OVERFLOW] == 0U);
    RC_ASSERT(stats[STAT_STUCK] == 0U);
}

std::vector<Oracle> oracles_of(const std::vector<SolidPtr>& solids)
{
    std::vector<Oracle> oracles;
    for (const SolidPtr& s : solids) oracles.emplace_back(s);
    return oracles;
}

/// Goes straight through all surfaces and asserts that they are the course's, each where rounding allows.
template <typename P>
std::vector<Hit> assert_course(const Native& scene, const Course& course, Path path)
{
    const Vec3 o = path.o, d = path.d;
    Stats stats{};
    std::vector<Hit> hits;
    std::vector<u32> inside = course.start;
    for (const Event& e : course.events) {
        const std::optional<Hit> hit = next_hit<P>(scene, path, inside, stats);
        RC_ASSERT(hit.has_value());
        RC_ASSERT(hit->before == e.before);
        RC_ASSERT(hit->after == e.after);
        RC_ASSERT(std::fabs(scene::dot(hit->p - o, d) - static_cast<double>(e.t)) <= static_cast<double>(e.blur));
        // The normal is that of the object shown: it looks back at a ray that enters.
        RC_ASSERT((scene::dot(hit->n, d) < 0) == (hit->object == hit->after));
        inside = e.inside_after;
        path = beyond(*hit, d);
        hits.push_back(*hit);
    }
    RC_ASSERT(!next_hit<P>(scene, path, inside, stats).has_value());
    assert_sound(stats);
    return hits;
}

/// The bodies at a size of their own, the ray with them, and what it must meet; discards what rounding may decide.
struct Case {
    double size = 1;
    std::vector<SolidPtr> solids;
    std::vector<Oracle> oracles;
    Path path;
    Course course;
};

Case draw(const std::vector<Body>& bodies)
{
    Case c;
    c.size = std::exp2(*generate::exponent().as("size, as a power of two"));
    for (const Body& body : bodies) c.solids.push_back(mapped(body.solid, {c.size}));
    c.oracles = oracles_of(c.solids);
    const Beam beam = *generate::beam();
    c.path = {beam.o * c.size, beam.d, MEMBER_NONE, false};
    const auto course = course_of(c.oracles, c.size, widen<W>(c.path.o), widen<W>(c.path.d), false);
    RC_PRE(course.has_value());
    c.course = *course;
    return c;
}

template <typename P>
class Properties : public ::testing::Test {
};
TYPED_TEST_SUITE(Properties, Machines, MachineNames);

TYPED_TEST(Properties, MembershipChangesExactlyAtTheSurfacesThatAreReported)
{
    static const auto bodies = generate::body(3);
    rc::detail::checkGTest([] {
        const Case c = draw({*bodies});
        RC_CLASSIFY(c.course.events.empty(), "misses");
        assert_course<TypeParam>(Native(scene_of(c.solids)), c.course, c.path);
    });
}

TYPED_TEST(Properties, OfObjectsThatOverlapTheFirstIsTheMedium)
{
    static const auto bodies = generate::body(1);
    rc::detail::checkGTest([] {
        const Case c = draw({*bodies, *bodies, *bodies});
        assert_course<TypeParam>(Native(scene_of(c.solids)), c.course, c.path);
    });
}

TYPED_TEST(Properties, ARayThatLeavesASurfaceMeetsWhatLiesAheadAndNeverThatSurfaceFalsely)
{
    using P = TypeParam;
    static const auto bodies = generate::body(2);
    rc::detail::checkGTest([] {
        const Case c = draw({*bodies});
        RC_PRE(!c.course.events.empty());
        const Native native(scene_of(c.solids));
        const std::vector<Hit> hits = assert_course<P>(native, c.course, c.path);
        const auto k = *generate::gen::inRange<std::size_t>(0, hits.size()).as("which surface");
        const Hit& hit = hits[k];
        const Vec3 d = to_real<P>(scene::unit(*generate::arrow().as("the direction that it leaves in")));
        // Ahead is the side that the ray was going to.
        const bool ahead = (scene::dot(d, hit.n) > 0) == (scene::dot(c.path.d, hit.n) > 0);
        const auto course = course_of(c.oracles, c.size, widen<W>(hit.p), widen<W>(d), true);
        RC_PRE(course.has_value());
        RC_ASSERT(course->start == (ahead ? c.course.events[k].inside_after : c.course.events[k].inside_before));
        assert_course<P>(native, *course, ahead ? beyond(hit, d) : back(hit, d));
    });
}

TYPED_TEST(Properties, TheSameSetWrittenInAnotherWayHasTheSameSurfaces)
{
    using P = TypeParam;
    static const auto bodies = generate::body(1);
    rc::detail::checkGTest([] {
        const Body a = *bodies, b = *bodies;
        const auto both = [](SolidPtr x, SolidPtr y) { return solid(scene::Intersection{{x, y}}); };
        const auto either = [](SolidPtr x, SolidPtr y) { return solid(scene::Union{{x, y}}); };
        const auto minus = [](SolidPtr x, SolidPtr y) { return solid(scene::Difference{x, y}); };
        const auto no = [](SolidPtr x) { return complement(x); };
        const SolidPtr &x = a.solid, &y = b.solid;
        const std::vector<std::vector<SolidPtr>> twins{
            {x, both(x, x), either(x, x), no(no(x)), either(x, both(x, y)), both(x, either(x, y))},
            {both(x, y), both(y, x), no(either(no(x), no(y))), minus(x, no(y)), minus(x, minus(x, y))},
            {either(x, y), either(y, x), no(both(no(x), no(y))), no(minus(no(x), y))},
            {minus(x, y), both(x, no(y)), no(either(no(x), y)), minus(x, both(x, y))}};
        const auto& forms = twins[*generate::gen::inRange<std::size_t>(0, twins.size()).as("which law")];
        const Case c = draw({Body{forms[0]}});
        for (const SolidPtr& form : forms)
            assert_course<P>(Native(scene_of({mapped(form, {c.size})})), c.course, c.path);
    });
}

TYPED_TEST(Properties, WhatIsMovedTogetherWithTheEyeHasTheSameSurfaces)
{
    static const auto bodies = generate::body(1);
    rc::detail::checkGTest([] {
        const Case c = draw({*bodies, *bodies});
        const auto far = std::exp2(*generate::whole(17).as("how far it is moved, as a power of two"));
        const Vec3 by = *generate::place().as("where to") * (far * c.size);
        std::vector<SolidPtr> elsewhere;
        for (const SolidPtr& s : c.solids) elsewhere.push_back(moved(s, by));
        Scene scene = scene_of(elsewhere);
        scene.observer = scene::Pinhole{by, by + Vec3{0, 1, 0} * (far * c.size), {0, 0, 1}, 45};
        assert_course<TypeParam>(Native(scene), c.course, c.path);
    });
}

/// Two walks whose every number is the other's, but for a factor of lengths and a mirror.
template <typename P>
void assert_similar(const Case& c, const Similarity& by)
{
    std::vector<SolidPtr> images;
    for (const SolidPtr& s : c.solids) images.push_back(mapped(s, by));
    const std::vector<Hit> hits = assert_course<P>(Native(scene_of(c.solids)), c.course, c.path);
    Course course = c.course;
    for (Event& e : course.events) e.t *= by.length, e.blur *= by.length;
    const Path path{by.point(c.path.o), by.direction(c.path.d), MEMBER_NONE, false};
    const std::vector<Hit> others = assert_course<P>(Native(scene_of(images)), course, path);
    for (std::size_t i = 0; i < hits.size(); i++) {
        RC_ASSERT(others[i].t == hits[i].t * by.length);
        RC_ASSERT(others[i].p == by.point(hits[i].p));
        RC_ASSERT(others[i].n == by.direction(hits[i].n));
    }
}

TYPED_TEST(Properties, ScalingByAPowerOfTwoScalesEverySurfaceBitForBit)
{
    static const auto bodies = generate::body(2);
    rc::detail::checkGTest([] {
        const Case c = draw({*bodies});
        // All sizes from 2^-13 to 2^20, whatever the case's own.
        const double other = std::exp2(*generate::exponent().as("the other size, as a power of two"));
        assert_similar<TypeParam>(c, {other / c.size});
    });
}

TYPED_TEST(Properties, MirroringMirrorsEverySurfaceBitForBit)
{
    static const auto bodies = generate::body(2);
    rc::detail::checkGTest([] { assert_similar<TypeParam>(draw({*bodies}), {1, true}); });
}

TYPED_TEST(Properties, ALosslessSceneInAWhiteSkyIsWhite)
{
    using P = TypeParam;
    static const auto bodies = generate::body(1);
    rc::detail::checkGTest([] {
        const double size = std::exp2(*generate::exponent().as("size, as a power of two"));
        Scene scene = empty_scene();
        scene.sky = scene::SkyColor{{1, 1, 1}};
        scene.settings.max_hops = 12;
        const Vec3 eye = Vec3{.1, -6, .3} * size;
        scene.observer = scene::Pinhole{eye, {0, 0, 0}, {0, 0, 1}, 45};
        const int count = *generate::gen::inRange(1, 4).as("objects");
        for (int i = 0; i < count; i++) {
            const int index = *generate::whole(20).as("index");
            Optics optics = index < 0 ? mirror() : clear(1 + index / 16.0);
            if (index > 10) optics.fresnel = true, optics.reflection = {1, 1, 1};
            const SolidPtr solid = mapped((*bodies).solid, {size});
            RC_PRE(optics.index > 0 || !Oracle(solid).holds(widen<W>(eye))); // it is black within a mirror
            add(scene, solid, optics);
        }
        RC_LOG() << scene::print_scene(scene);
        View view;
        view.width = 8;
        view.height = 6;
        const Image image = render<P>(scene, view);
        assert_sound(image.stats);
        double dark = 0;
        for (unsigned j = 0; j < view.height; j++)
            for (unsigned i = 0; i < view.width; i++) dark += 1 - static_cast<double>(image.at(i, j).r);
        // What is missing is what the statistics report as truncated, each branch's rounded down to 2^-16.
        const double truncated = image.stats[STAT_TRUNCATED] * 0x1p-16;
        const double branches = image.stats[STAT_CUT_BRANCHES] + image.stats[STAT_HOP_BRANCHES];
        const double rounding = 1e-5 * view.width * view.height;
        RC_ASSERT(dark >= truncated - rounding);
        RC_ASSERT(dark <= truncated + branches * 0x1p-16 + rounding);
    });
}

RC_GTEST_PROP(Scenes, WhatIsWrittenIsReadBackAsAnEqualScene, ())
{
    static const auto scenes = generate::scene();
    const Scene scene = *rc::gen::noShrink(scenes);
    const std::string text = scene::print_scene(scene);
    RC_LOG() << text;
    const Scene again = scene::read_scene(text, "test", scene::Format::clucida, ".");
    RC_ASSERT(again == scene);
    RC_ASSERT(scene::print_scene(again) == text);
}

bool finite(const float* begin, std::size_t count)
{
    return std::all_of(begin, begin + count, [](float x) { return std::isfinite(x); });
}

template <typename T>
bool all_finite(const Native& scene, LayoutBuffer buffer)
{
    return std::ranges::all_of(scene.items<T>(buffer), [](const T& item) {
        return finite(reinterpret_cast<const float*>(&item), sizeof item / sizeof(float));
    });
}

RC_GTEST_PROP(Scenes, AnyValidSceneCompilesToFiniteNumbers, ())
{
    static const auto scenes = generate::scene();
    Scene scene = *rc::gen::noShrink(scenes);
    const double size = std::exp2(*generate::exponent().as("size, as a power of two"));
    for (auto& object : scene.objects) object.solid = mapped(object.solid, {size});
    RC_LOG() << scene::print_scene(scene);
    const Native native(scene);
    RC_ASSERT(all_finite<LayoutPlane>(native, BUFFER_PLANES));
    RC_ASSERT(all_finite<LayoutSphere>(native, BUFFER_SPHERES));
    RC_ASSERT(all_finite<LayoutQuadric>(native, BUFFER_QUADRICS));
    RC_ASSERT(all_finite<LayoutLight>(native, BUFFER_LIGHTS));
    for (const LayoutOptics& o : native.items<LayoutOptics>(BUFFER_OPTICS))
        RC_ASSERT(std::isfinite(o.index) && !std::isnan(o.extinction[0] + o.extinction[1] + o.extinction[2]));
    for (const LayoutObject& o : native.items<LayoutObject>(BUFFER_OBJECTS)) {
        RC_ASSERT(finite(o.center, 3));
        RC_ASSERT(o.radius >= 0 && o.near >= 0); // either may be infinite
    }
}

} // namespace
} // namespace clucida::test

int main(int argc, char** argv)
{
#ifdef NDEBUG
    setenv("RC_PARAMS", "seed=20160729 max_success=20000 max_discard_ratio=50", 0);
#else
    setenv("RC_PARAMS", "seed=20160729 max_success=1000 max_discard_ratio=50", 0);
#endif
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
