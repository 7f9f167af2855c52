// What the oracle tells of paths: the same in every real type and on any number of threads; sound logs; what was cut
// off; disturbances.
#include "oracle_world.h"

#include <fmt/format.h>

namespace clucida::oracle {
namespace {

const std::vector<std::string> scenes{"bricks.clu",  "drink.clu", "emitters.clu",  "fresnel.clu", "gems.clu",
                                      "globes.clu",  "lamp.clu",  "lenses.clu",    "mirrors.clu", "overlap.clu",
                                      "planets.clu", "rings.clu", "sculpture.clu", "shells.clu",  "original.rayt"};

Options small_picture()
{
    Options options;
    options.view.width = 24;
    options.view.height = 14;
    return options;
}

template <typename Real>
std::vector<Path> paths_of(const scene::Scene& scene, const std::vector<Pixel>& pixels, unsigned threads = 2)
{
    return render<Real>(build<Real>(scene, small_picture()), pixels, threads);
}

/// How many paths are not the same, and the largest difference in colour of those that are.
struct Difference {
    std::size_t paths = 0;
    double color = 0;
};
Difference difference(const std::vector<Path>& a, const std::vector<Path>& b)
{
    Difference d;
    for (std::size_t i = 0; i < a.size(); i++) {
        if (a[i].events != b[i].events)
            d.paths++;
        else
            d.color = std::max(d.color, farthest(a[i].rgb, b[i].rgb));
    }
    return d;
}

TEST(OraclePaths, AreTheSameInEveryRealType)
{
    for (const std::string& name : scenes) {
        SCOPED_TRACE(name);
        const scene::Scene scene = shipped(name);
        const std::vector<Pixel> all = all_pixels(small_picture().view);
        std::vector<Pixel> some;
        for (std::size_t i = 3; i < all.size(); i += 11) some.push_back(all[i]);
        const auto in_quad = paths_of<Quad>(scene, some);
        const Difference d = difference(paths_of<double>(scene, some), in_quad);
        const Difference l = difference(paths_of<long double>(scene, some), in_quad);
        const Difference b = difference(paths_of<Big>(scene, some), in_quad);
        EXPECT_EQ(d.paths, 0U);
        EXPECT_EQ(l.paths, 0U);
        EXPECT_EQ(b.paths, 0U);
        EXPECT_LE(d.color, 1e-11);
        EXPECT_LE(l.color, 1e-14);
        EXPECT_LE(b.color, 4e-16) << "both are right to the last bit of double, nearly";
    }
}

/// Appends the path that begins with the branch, in the order of tracing.
void follow_segments(const World<long double>& world, const Branch<long double>& branch, std::vector<Event>& events)
{
    const Segment<long double> s = segment(world, branch);
    if (!s.event) return;
    EXPECT_EQ(s.reflected.has_value(), (s.event->what & what_reflected) != 0);
    EXPECT_EQ(s.refracted.has_value(), (s.event->what & what_refracted) != 0);
    events.push_back(*s.event);
    if (s.reflected) follow_segments(world, *s.reflected, events);
    if (s.refracted) follow_segments(world, *s.refracted, events);
}

TEST(OraclePaths, AreTheSameSegmentBySegment)
{
    for (const std::string& name : scenes) {
        SCOPED_TRACE(name);
        const auto world = build<long double>(shipped(name), small_picture());
        const std::vector<Pixel> all = all_pixels(small_picture().view);
        for (std::size_t i = 3; i < all.size(); i += 11) {
            std::vector<Event> events;
            follow_segments(world, observer_branch(world, all[i].x, all[i].y, all[i].sample), events);
            EXPECT_EQ(events, observe(world, all[i].x, all[i].y, all[i].sample).events) << i;
        }
    }
}

TEST(OraclePaths, ABranchIsDisturbedInAllItsNumbersByAtMostTheSize)
{
    Options options = small_picture();
    const scene::Scene scene = read("observer { eye [1,2,3]; look [0,1,0] }");
    Branch<double> branch;
    branch.o = {5, 2, 3};
    branch.d = {0, 0, 1};
    branch.throughput = {0.5, 0.25, 0};
    const auto same = disturbed(build<double>(scene, options), branch, 7);
    EXPECT_EQ(same.o, branch.o);
    options.disturbance = Disturbance{1, 1e-6};
    const auto world = build<double>(scene, options);
    const auto one = disturbed(world, branch, 7), other = disturbed(world, branch, 8);
    for (std::size_t k = 0; k < 3; k++) {
        EXPECT_NE(one.o[k], branch.o[k]);
        EXPECT_NEAR(one.o[k], branch.o[k], 4e-6) << "4 from the eye";
        EXPECT_NE(one.o[k], other.o[k]);
        EXPECT_NEAR(one.d[k], branch.d[k], 1e-6);
        EXPECT_NEAR(one.throughput[k], branch.throughput[k], 1e-6 * branch.throughput[k]);
    }
    EXPECT_NE(one.d[0], 0);
    EXPECT_NE(one.throughput[0], branch.throughput[0]);
}

TEST(OraclePaths, DoNotDependOnHowManyThreadsTraceThem)
{
    const scene::Scene scene = shipped("drink.clu");
    const std::vector<Pixel> pixels = all_pixels(small_picture().view);
    const std::vector<Path> one = paths_of<long double>(scene, pixels, 1);
    for (const unsigned threads : {2U, 3U, 8U}) {
        const std::vector<Path> many = paths_of<long double>(scene, pixels, threads);
        ASSERT_EQ(many.size(), one.size());
        for (std::size_t i = 0; i < one.size(); i++) {
            ASSERT_EQ(many[i].events, one[i].events);
            ASSERT_EQ(many[i].rgb, one[i].rgb);
            ASSERT_EQ(many[i].truncated, one[i].truncated);
        }
    }
}

/// Reads the segment at `at` with all that follows from it; returns where the next begins.
std::size_t check_segment(const std::vector<Event>& events, std::size_t at, std::uint32_t hop)
{
    if (at >= events.size()) {
        ADD_FAILURE() << "a branch that was followed is missing";
        return at;
    }
    const Event& event = events[at];
    EXPECT_EQ(event.hop, hop);
    const std::uint32_t branches = event.what & (what_reflected | what_refracted);
    if (event.object == vacuum) {
        EXPECT_EQ(event, (Event{hop, vacuum, vacuum, 0, 0})) << "the sky";
    } else {
        EXPECT_NE(event.face, vacuum);
        EXPECT_TRUE(!(event.what & what_emitted) || branches == 0);
        EXPECT_TRUE(!(event.what & what_total) || !(branches & what_refracted));
    }
    at++;
    if (branches & what_reflected) at = check_segment(events, at, hop + 1);
    if (branches & what_refracted) at = check_segment(events, at, hop + 1);
    return at;
}

TEST(OraclePaths, TellEverySegmentBeforeThoseThatFollowFromIt)
{
    std::uint32_t seen = 0;
    for (const std::string& name : scenes) {
        SCOPED_TRACE(name);
        const scene::Scene scene = shipped(name);
        const auto faces_of = faces(scene);
        for (const Path& path : paths_of<double>(scene, all_pixels(small_picture().view))) {
            if (path.events.empty()) continue; // the observer stands in something opaque
            EXPECT_EQ(check_segment(path.events, 0, 0), path.events.size());
            for (const Event& event : path.events) {
                EXPECT_LT(event.hop, scene.settings.max_hops);
                seen |= event.what;
                if (event.object == vacuum) continue;
                ASSERT_LT(event.object, faces_of.size());
                EXPECT_LT(event.face, faces_of[event.object].size());
            }
        }
    }
    EXPECT_EQ(seen, 31U) << "every bit of What occurs somewhere";
}

TEST(OraclePaths, TellWhatCutoffAndHopsTookAway)
{
    // Between two mirrors that give back half, in water that lets through half per unit: 2 units a segment.
    const std::string hall = "sky color 1\nobject { solid plane([0,0,0], [0,0,1]); optics { reflection 0.5 } }\n"
                             "object { solid plane([0,0,2], [0,0,-1]); optics { reflection 0.5 } }\n";
    const std::string water = "object { solid !sphere([0,0,900], 1); optics { index 1; passthrough 0.5 } }\n";
    const Three<double> o{0, 0, 1}, d{0, 0, 1};
    const Path by_hops = follow(world_of<InDouble>(hall, free_options(5)), o, d);
    EXPECT_EQ(by_hops.events.size(), 5U);
    EXPECT_EQ(by_hops.truncated, std::pow(.5, 5));
    const Path in_water = follow(world_of<InDouble>(hall + water, free_options(5)), o, d);
    EXPECT_NEAR(in_water.truncated, std::pow(.5, 5) * std::pow(.5, 9), 1e-18) << "passthrough is part of the weight";
    Options cutoff = free_options(19);
    cutoff.view.cutoff = .2;
    const Path by_cutoff = follow(world_of<InDouble>(hall + water, cutoff), o, d);
    EXPECT_EQ(by_cutoff.events.size(), 3U) << "passthrough is no part of the throughput";
    EXPECT_NEAR(by_cutoff.truncated, std::pow(.5, 3) * std::pow(.5, 5), 1e-18);
    const Path whole = follow(world_of<InDouble>("sky color 1\n", free_options(1)), o, d);
    EXPECT_EQ(whole.truncated, 0);
    EXPECT_EQ(whole.rgb, (Three<double>{1, 1, 1}));
}

TEST(OracleDisturbances, OfSizeZeroChangeNothing)
{
    const std::vector<Pixel> pixels = all_pixels(small_picture().view);
    for (const char* name : {"lenses.clu", "rings.clu"}) {
        const scene::Scene scene = shipped(name);
        Options options = small_picture();
        const auto plain = render<Quad>(build<Quad>(scene, options), pixels, 2);
        options.disturbance = Disturbance{5, 0};
        const auto disturbed = render<Quad>(build<Quad>(scene, options), pixels, 2);
        const Difference d = difference(plain, disturbed);
        EXPECT_EQ(d.paths, 0U);
        EXPECT_LE(d.color, 1e-16) << "coordinates take a way over the eye and back";
    }
}

TEST(OracleDisturbances, ChangeNoNumberByMoreThanTheirSizeAndEqualNumbersAlike)
{
    const auto change = [](std::uint64_t seed, double x, std::uint64_t object = 0, bool apart = false) {
        return disturbed_by(Disturbance{seed, 0x1p-20, apart}, x, object) - 1;
    };
    Random random(1);
    double most = 0;
    for (std::uint64_t i = 0; i < 1000; i++) {
        const double x = std::ldexp(uniform(random, 1, 2), static_cast<int>(random() % 200) - 30);
        EXPECT_LE(std::fabs(change(i, x)), 0x1p-20);
        EXPECT_EQ(change(i, -x), change(i, x));
        EXPECT_EQ(change(i, x, 1), change(i, x, 2));
        EXPECT_NE(change(i, x, 1, true), change(i, x, 2, true));
        EXPECT_NE(change(i + 1, x), change(i, x));
        most = std::max(most, std::fabs(change(i, x)));
    }
    EXPECT_GT(most, .95 * 0x1p-20);
    for (std::uint64_t seed = 0; seed < 100; seed++) {
        EXPECT_EQ(change(seed, .1 + .2), change(seed, .3));
        EXPECT_EQ(change(seed, std::nextafter(1.0, 0.0)), change(seed, 1));
    }
    EXPECT_EQ(disturbed_by(std::nullopt, 3, 1), 1);
}

TEST(OracleDisturbances, MoveASphereByTheirSizeAndLeaveFlushFacesFlushUnlessApart)
{
    const std::string clear = "; optics { index 1; refraction 1 } }\n";
    const scene::Scene ball = read("object { solid sphere([0,9,0], 2)" + clear);
    const scene::Scene stack =
        read("object { solid cuboid([0,5,0], [4,0.3,4])" + clear + "object { solid cuboid([0,5.3,0], [4,0.3,4])" +
             clear + "object { solid move([0,5.45,0], cuboid([0,0.15,0], [4,0.3,4]))" + clear);
    const Three<double> o{0, 0, 0}, d{.01, 1, .02};
    const double plain = next(build<double>(ball, {}), o, d)->t;
    double most = 0;
    std::size_t gaps = 0;
    for (std::uint64_t seed = 1; seed <= 100; seed++) {
        Options options;
        options.disturbance = Disturbance{seed, 1e-6};
        const double t = next(build<double>(ball, options), o, d)->t;
        most = std::max(most, std::fabs(t - plain));
        ASSERT_EQ(surfaces_along(build<double>(stack, options), o, d).size(), 4U) << "no vacuum, seed " << seed;
        options.disturbance->apart = true;
        if (surfaces_along(build<double>(stack, options), o, d).size() > 4) gaps++;
    }
    EXPECT_LE(most, 1.2e-5) << "9 by the centre, 2 by the radius";
    EXPECT_GE(most, 4e-6);
    EXPECT_GT(gaps, 20U);
}

TEST(OracleDisturbances, MeetAsOneWhatTheyCanBringToOnePlaceWhenMerging)
{
    const scene::Scene film = read("object { solid cuboid([0,5,0], [4,4e-6,4]); optics { index 1; refraction 1 } }\n");
    for (const double size : {1e-8, 1e-5}) {
        Options options;
        options.disturbance = Disturbance{1, size, false, true};
        const auto hit = next(build<double>(film, options), {0, 0, 0}, {0, 1, 0});
        EXPECT_EQ(hit.has_value(), size < 1e-6) << "at a size of " << size;
    }
}

TEST(Oracle, DoesNotImitateTheOriginalProgramAndSaysSo)
{
    Options options;
    options.view.as_original = scene::AsOriginal::gun;
    EXPECT_THROW(build<double>(shipped("original.gun"), options), std::invalid_argument);
}

TEST(Oracle, StoresFiltersAsCoarselyAsTheKernelsWhenAsked)
{
    const scene::Scene scene = read("object { solid plane([0,1,0], [0,-1,0]); optics { index -1; refraction "
                                    "[0.3, 1, 0.7] } }");
    Options options;
    const Three<double> o{0, 0, 0}, d{0, 1, 0};
    EXPECT_EQ(follow(build<double>(scene, options), o, d).rgb, (Three<double>{.3, 1, .7}));
    options.stored_colors = true;
    const Three<double> stored = follow(build<double>(scene, options), o, d).rgb;
    EXPECT_NEAR(stored[0], .3, std::sqrt(.3) / 2047);
    EXPECT_NE(stored[0], .3);
    EXPECT_EQ(stored[1], 1);
    EXPECT_NEAR(stored[2], .7, std::sqrt(.7) / 1023);
}

} // namespace
} // namespace clucida::oracle
