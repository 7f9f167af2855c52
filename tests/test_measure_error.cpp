// The error that `clucida-bench error` reports, on scenes whose error is known. Needs an OpenCL device.
#include "bench/measure_error.h"
#include "glass_scene.h"
#include "host/signatures.h"
#include "scene/read.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clucida::bench {
namespace {

host::SceneSource source_of(const std::string& text)
{
    host::SceneSource out;
    out.name = "test";
    out.scene = scene::read_scene(text, "test", scene::Format::clucida, ".");
    return out;
}

ErrorSettings small()
{
    ErrorSettings out;
    out.picture = {48, 27};
    out.repeats = 1;
    return out;
}

host::Device device()
{
    return host::find_device(host::device_selector(""));
}

TEST(MeasureError, TheKernelsAgreeWithTheOracleOnGlassUpToRounding)
{
    ErrorSettings settings = small();
    settings.contenders = {{host::Precision::single, "full"}, {host::Precision::twofold, "full"}};
    const SceneError e = measure_error(source_of(test::glass_scene), device(), settings, {});
    ASSERT_EQ(e.reports.size(), 2U);
    for (const ErrorReport& r : e.reports) {
        EXPECT_EQ(r.pixels, 48U * 27U);
        EXPECT_EQ(unexplained_flips(r), 0);
        EXPECT_LE(r.agreeing.rmse, 2e-6);
        EXPECT_EQ(r.statistics.parity, 0U);
        EXPECT_GT(r.kernel.rays, 1000U);
        EXPECT_LE(r.kernel.worst, 8);
        EXPECT_EQ(r.kernel.wrong, 0U);
        EXPECT_GT(r.milliseconds, 0);
    }
    EXPECT_GT(e.reports[0].agreeing.rmse, 0) << "float pictures are never exact";
    EXPECT_LT(e.reports[1].agreeing.rmse, e.reports[0].agreeing.rmse) << "double is nearer";
    EXPECT_GT(e.rounding.rmse, 1e-9);
    EXPECT_LT(e.rounding.rmse, 2e-6);
    EXPECT_GT(e.colors.rmse, 0) << "0.1, 0.9 and 0.2 are not among the stored colours";
}

TEST(MeasureError, ASceneThatNothingIsSparedInHasNoCosts)
{
    const SceneError e = measure_error(source_of(R"(clucida 1
observer { eye [0, -6, 2]; look [0, 0, 0.8]; fov 45 }
sky color 0.5
object { solid sphere([0, 0, 1], 1); optics { reflection 1 } }
)"),
                                       device(), small(), {});
    for (const Cost& cost : {e.rounding, e.colors, e.cutoff, e.hops}) EXPECT_EQ(cost.max_error, 0);
    EXPECT_EQ(e.reports[0].all.max_error, 0);
    EXPECT_EQ(e.reports[0].flips, 0U);
}

TEST(MeasureError, AHopLimitCostsWhatItCutsOff)
{
    const SceneError e = measure_error(source_of(R"(clucida 1
observer { eye [0, -6, 0]; look [0, 0, 0]; fov 45 }
settings { hops 1 }
sky color 0.5
object { solid sphere([0, 0, 0], 1); optics { reflection 1 } }
)"),
                                       device(), small(), {});
    EXPECT_EQ(e.hops.max_error, 0.5) << "the ball reflects the sky from the second hop on";
    EXPECT_EQ(e.cutoff.max_error, 0);
}

/// Paths as the kernels tell them.
class Signatures : public ::testing::Test {
protected:
    void SetUp() override
    {
        view.width = 48;
        view.height = 27;
        compiled = scene::compile(source.scene, view);
        settings.picture = {48, 27};
        settings.kernel = host::KernelShape::pixels; // the paths are those of single rays
        frame = host::render_frame(renderer, compiled, settings);
        for (unsigned y = 0; y < 27; y++)
            for (unsigned x = 0; x < 48; x++) pixels.push_back({x, y});
    }
    std::vector<host::PixelPath> trace(unsigned capacity)
    {
        host::PathTracer tracer = host::make_path_tracer(renderer, compiled, frame.needs, settings);
        host::Statistics statistics;
        return host::trace_paths(tracer, pixels, 0, capacity, statistics);
    }
    host::SceneSource source = source_of(test::glass_scene);
    scene::View view;
    scene::Compiled compiled;
    host::RenderSettings settings;
    host::Renderer renderer = host::make_renderer(device());
    host::Frame frame;
    std::vector<host::Pixel> pixels;
};

TEST_F(Signatures, TheColoursAreThePicturesBitForBit)
{
    const auto paths = trace(4);
    for (std::size_t i = 0; i < paths.size(); i++)
        for (std::size_t k = 0; k < 3; k++) ASSERT_EQ(paths[i].rgb[k], frame.picture.rgb[3 * i + k]) << i;
}

TEST_F(Signatures, TheLogIsTheFirstEventsAndTheHashIsOfAll)
{
    const auto whole = trace(64), cut = trace(2), none = trace(0), again = trace(64);
    unsigned longer = 0;
    for (std::size_t i = 0; i < whole.size(); i++) {
        ASSERT_EQ(whole[i].log.size(), whole[i].events);
        EXPECT_EQ(cut[i].log.size(), std::min(whole[i].events, 2U));
        EXPECT_TRUE(none[i].log.empty());
        for (const auto* other : {&cut, &none, &again}) {
            EXPECT_EQ((*other)[i].hash, whole[i].hash);
            EXPECT_EQ((*other)[i].events, whole[i].events);
        }
        longer += whole[i].events > 2 ? 1 : 0;
    }
    EXPECT_GT(longer, 100U);
}

TEST_F(Signatures, RaysAreToldOfTheSegmentsInTheLogWhereAskedFor)
{
    const auto without = trace(2);
    for (const host::Precision precision : {host::Precision::single, host::Precision::twofold}) {
        settings.precision = precision;
        host::PathTracer tracer = host::make_path_tracer(renderer, compiled, frame.needs, settings);
        host::Statistics statistics;
        const auto paths = host::trace_paths(tracer, pixels, 0, 2, statistics, host::KeepRays::yes);
        unsigned beyond_float = 0;
        for (std::size_t i = 0; i < paths.size(); i++) {
            EXPECT_TRUE(without[i].rays.empty());
            ASSERT_EQ(paths[i].rays.size(), paths[i].log.size());
            if (precision == host::Precision::single) {
                EXPECT_EQ(paths[i].hash, without[i].hash);
            }
            EXPECT_EQ(paths[i].rays[0].o, (std::array<double, 3>{})) << "the eye";
            EXPECT_EQ(paths[i].rays[0].throughput, (std::array<double, 3>{1, 1, 1}));
            for (const host::SegmentRay& r : paths[i].rays) {
                EXPECT_NEAR(std::hypot(r.d[0], r.d[1], r.d[2]), 1, 2e-7);
                if (double{static_cast<float>(r.d[1])} != r.d[1]) beyond_float++;
            }
        }
        EXPECT_EQ(beyond_float > 1000, precision == host::Precision::twofold) << beyond_float;
        EXPECT_EQ(beyond_float == 0, precision == host::Precision::single) << beyond_float;
    }
}

TEST_F(Signatures, AnEventHasAsManyFollowersAsItSays)
{
    for (const host::PixelPath& path : trace(64)) {
        std::size_t at = 0, expected = 1;
        for (const LayoutEvent& e : path.log) {
            ASSERT_LT(at, expected);
            expected += (e.what & EVENT_REFLECTED ? 1U : 0U) + (e.what & EVENT_REFRACTED ? 1U : 0U);
            at++;
        }
        EXPECT_EQ(at, expected);
    }
}

} // namespace
} // namespace clucida::bench
