// Whether the kernels' paths hold step by step. Needs an OpenCL device.
#include "bench/measure_error.h"
#include "bench/steps.h"
#include "glass_scene.h"
#include "scene/read.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace clucida::bench {
namespace {

constexpr const char* three_balls = R"(clucida 1
observer { eye [0, -6, 0.3]; look [0, 0, 0.1]; fov 36 }
settings { hops 30; cutoff 0.001 }
sky gradient { low 0.2; middle 0.8; high [0.2, 0.4, 1] }
light { point [5, -5, 8] }
optics mirror { reflection 0.95; absorption 0.05 }
object { solid sphere([-1.03, 0, -0.6], 1); optics mirror }
object { solid sphere([1.03, 0, -0.6], 1); optics mirror }
object { solid sphere([0, 0.3, 1.2], 1); optics mirror }
)";

constexpr unsigned width = 48, height = 27, seeds = 100;
constexpr double tampering = 100 * 0x1p-24;

/// A scene's paths as the kernels trace them.
struct Traced {
    explicit Traced(const std::string& text, host::Precision precision = host::Precision::single)
    {
        scene = scene::read_scene(text, "test", scene::Format::clucida, ".");
        options.view.width = width;
        options.view.height = height;
        options.stored_colors = true;
        const scene::Compiled compiled = scene::compile(scene, options.view);
        names = match_faces(scene, compiled);
        host::Renderer renderer = host::make_renderer(host::find_device(host::device_selector("")));
        host::RenderSettings settings;
        settings.picture = {width, height};
        settings.precision = precision;
        const host::Frame frame = host::render_frame(renderer, compiled, settings);
        host::PathTracer tracer = host::make_path_tracer(renderer, compiled, frame.needs, settings);
        std::vector<host::Pixel> pixels;
        for (unsigned y = 0; y < height; y++)
            for (unsigned x = 0; x < width; x++) pixels.push_back({x, y});
        host::Statistics statistics;
        const auto paths = host::trace_paths(tracer, pixels, 0, 256, statistics, host::KeepRays::yes);
        for (std::size_t i = 0; i < paths.size(); i++)
            trails.push_back(trail_of({pixels[i].x, pixels[i].y, 0}, paths[i]));
    }

    /// Along a path's first branch to its end; where both are followed the first is the reflected one.
    Trail trail_of(const oracle::Pixel& pixel, const host::PixelPath& path) const
    {
        const std::vector<oracle::Event> events = names.kernel(path.log);
        Trail out{pixel, {}, {}};
        for (std::size_t i = 0; i < events.size(); i++) {
            const std::uint32_t reflected = events[i].what & EVENT_REFLECTED,
                                refracted = events[i].what & EVENT_REFRACTED;
            out.way.push_back({events[i], reflected ? reflected : refracted, i});
            out.rays.push_back(path.rays[i]);
            if (!reflected && !refracted) break;
        }
        return out;
    }

    std::vector<Verdict> judge(std::span<const Trail> of) const
    {
        return judge_steps(scene, options, names, of, seeds, 2);
    }
    Verdict judge(const Trail& of) const { return judge({&of, 1})[0]; }

    Trail longest() const
    {
        return *std::ranges::max_element(trails, {}, [](const Trail& t) { return t.way.size(); });
    }

    scene::Scene scene;
    oracle::Options options;
    FaceNames names;
    std::vector<Trail> trails;
};

void expect_steps_to_hold(const char* scene)
{
    for (const host::Precision precision : {host::Precision::single, host::Precision::twofold}) {
        const Traced traced(scene, precision);
        const std::vector<Verdict> verdicts = traced.judge(traced.trails);
        std::size_t long_ones = 0;
        for (std::size_t i = 0; i < verdicts.size(); i++) {
            EXPECT_TRUE(verdicts[i].holds()) << i << ": " << why_not(verdicts[i]);
            EXPECT_EQ(verdicts[i].steps.size(), traced.trails[i].way.size() + 1);
            long_ones += traced.trails[i].way.size() >= 3 ? 1 : 0;
        }
        EXPECT_GT(long_ones, 20U);
    }
}

TEST(Steps, OfTheKernelsHoldOnGlassAndAFloor)
{
    expect_steps_to_hold(test::glass_scene);
}

TEST(Steps, OfTheKernelsHoldAmongThreeMirrorBalls)
{
    expect_steps_to_hold(three_balls);
}

class TamperedSteps : public ::testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_GE(trail.way.size(), 4U);
        ASSERT_TRUE(traced.judge(trail).holds());
    }
    Traced traced{three_balls};
    Trail trail = traced.longest();
};

TEST_F(TamperedSteps, DoNotHoldWhereARayIsMoved)
{
    for (std::size_t ray = 0; ray < 3; ray++) {
        for (std::size_t k = 0; k < 3; k++) {
            Trail moved = trail;
            moved.rays[ray].o[k] += 6 * tampering; // 6: the scene's distance from the eye
            const Verdict verdict = traced.judge(moved);
            EXPECT_FALSE(verdict.steps[ray].holds) << ray << ' ' << k;
            EXPECT_GT(verdict.steps[ray].met, 0U);
        }
    }
}

/// On a floor: a ball makes more than that of the roundings of where it is met.
TEST(Steps, DoNotHoldWhereARayIsTurned)
{
    const Traced traced(test::glass_scene);
    const auto from_floor = std::ranges::find_if(traced.trails, [](const Trail& t) {
        return t.way.size() >= 2 && t.way[0].event.object == 1 && t.way[0].branch == EVENT_REFLECTED;
    });
    ASSERT_NE(from_floor, traced.trails.end());
    ASSERT_TRUE(traced.judge(*from_floor).holds());
    for (std::size_t ray = 0; ray < 2; ray++) {
        for (std::size_t k = 0; k < 3; k++) {
            Trail turned = *from_floor;
            turned.rays[ray].d[k] += tampering; // its length does not matter
            const auto& d = from_floor->rays[ray].d;
            ASSERT_GT(std::hypot(d[(k + 1) % 3], d[(k + 2) % 3]), 0.3) << "a turn of 30u at least";
            EXPECT_FALSE(traced.judge(turned).steps[ray].holds) << ray << ' ' << k;
        }
    }
}

TEST_F(TamperedSteps, DoNotHoldWhereTheLightIsAnother)
{
    for (double& channel : trail.rays[2].throughput) channel *= 1 + tampering;
    const Verdict verdict = traced.judge(trail);
    EXPECT_FALSE(verdict.steps[2].holds);
    EXPECT_EQ(why_not(verdict).rfind("hop 1: ", 0), 0U) << why_not(verdict);
}

TEST_F(TamperedSteps, DoNotHoldWhereAnotherSurfaceIsMet)
{
    for (std::size_t i = 0; i < trail.way.size() - 1; i++) {
        Trail other = trail;
        other.way[i].event.object = (other.way[i].event.object + 1) % 3;
        const Verdict verdict = traced.judge(other);
        EXPECT_FALSE(verdict.steps[i + 1].holds);
        EXPECT_EQ(why_not(verdict), "hop " + std::to_string(i) + ": met by no trial");
    }
    Trail other = trail;
    other.way[0].event.face++;
    EXPECT_FALSE(traced.judge(other).holds());
    other = trail;
    other.way[0].event.what ^= EVENT_ENTERING;
    EXPECT_FALSE(traced.judge(other).holds());
}

TEST_F(TamperedSteps, DoNotHoldWhereTheEndIsAnotherThoughTheSurfaceIsTheSame)
{
    Trail cut = trail; // ended where the path goes on
    cut.way.resize(2);
    cut.rays.resize(2);
    cut.way[1].branch = 0;
    EXPECT_TRUE(traced.judge(cut).holds());
    for (const std::uint32_t bit : {EVENT_REFLECTED, EVENT_REFRACTED, EVENT_TOTAL, EVENT_EMITTED}) {
        Trail other = cut;
        other.way[1].event.what ^= bit;
        EXPECT_FALSE(traced.judge(other).holds()) << bit;
    }
    cut.way[1].event.lights ^= 1;
    EXPECT_FALSE(traced.judge(cut).holds());
}

TEST(Steps, ExplainWhatNoWholePathDoesButNotWhatNaiveKernelsMakeOfIt)
{
    host::SceneSource source = host::load_scene({CLUCIDA_SCENES "/sculpture.clu", "", "", false});
    ErrorSettings settings;
    settings.picture = {96, 54};
    settings.repeats = 1;
    settings.costs = false;
    settings.contenders = {{host::Precision::single, "full"}, {host::Precision::single, "naive"}};
    const SceneError e = measure_error(source, host::find_device(host::device_selector("")), settings, {});
    const Explained &full = e.reports[0].explained, &naive = e.reports[1].explained;
    EXPECT_GT(full.step_by_step, 0U);
    EXPECT_GT(full.explained, full.step_by_step) << "whole paths explain most";
    EXPECT_TRUE(full.unexplained.empty()) << full.unexplained[0].why;
    EXPECT_EQ(full.explained, full.looked_at);
    EXPECT_GT(naive.unexplained.size(), 20U);
    EXPECT_EQ(naive.explained + naive.unexplained.size(), naive.looked_at);
    for (const UnexplainedFlip& flip : naive.unexplained) EXPECT_FALSE(flip.why.empty());
}

} // namespace
} // namespace clucida::bench
