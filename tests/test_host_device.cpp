// What needs an OpenCL device. Without one these tests fail; they never skip.
#include "glass_scene.h"
#include "host/devices.h"
#include "host/errors.h"
#include "host/program.h"
#include "host/renderer.h"
#include "host/selftest.h"
#include "scene/read.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace clucida::host {
namespace {

scene::Compiled compiled(Shape size, unsigned samples)
{
    const scene::Scene scene = scene::read_scene(test::glass_scene, "test", scene::Format::clucida, ".");
    scene::View view;
    view.width = size.width;
    view.height = size.height;
    view.samples = samples;
    return scene::compile(scene, view);
}

RenderSettings settings(Shape size, unsigned samples)
{
    RenderSettings s;
    s.picture = size;
    s.samples = samples;
    return s;
}

TEST(Device, a_missing_OpenCL_device_fails_the_suite)
{
    EXPECT_FALSE(list_devices().empty()) << "no OpenCL device: the suite needs one, such as pocl-opencl-icd";
    EXPECT_NO_THROW(find_device(device_selector("")));
}

TEST(Device, exact_arithmetic_survives_the_compiler)
{
    for (const Device& device : list_devices()) EXPECT_EQ(self_test(device), "") << describe(device.info);
}

TEST(Device, exact_arithmetic_needs_no_fma_of_the_device)
{
    for (Device device : list_devices()) {
        device.info.has_fma = false;
        EXPECT_EQ(self_test(device), "") << describe(device.info);
    }
}

TEST(Device, a_kernel_that_does_not_compile_names_the_true_file_and_line)
{
    const Device device = find_device(device_selector(""));
    const Renderer renderer = make_renderer(device);
    try {
        build_program(renderer.context, device, "#line 7 \"kernels/x.h\"\n__kernel void k() { nonsense; }\n", "",
                      KernelCache::off);
        FAIL() << "nonsense was compiled";
    } catch (const Failure& e) {
        EXPECT_NE(std::string(e.what()).find("kernels/x.h:7:"), std::string::npos) << e.what();
    }
}

TEST(Device, a_program_from_the_cache_is_the_same_as_one_from_its_source)
{
    const auto folder = std::filesystem::temp_directory_path() / ("clucida_cache_" + std::to_string(::getpid()));
    ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    const Device device = find_device(device_selector(""));
    const Renderer renderer = make_renderer(device);
    const std::string source = "__kernel void k(__global int* a) { a[get_global_id(0)] = 42; }";
    const auto build = [&] { return build_program(renderer.context, device, source, "", KernelCache::always); };
    EXPECT_FALSE(build().from_cache);
    const Program program = build();
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(program.from_cache) << program.note;
    cl::Kernel kernel(program.handle, "k");
    const cl::Buffer buffer(renderer.context, CL_MEM_READ_WRITE, sizeof(cl_int));
    kernel.setArg(0, buffer);
    renderer.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1));
    cl_int answer = 0;
    renderer.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, sizeof answer, &answer);
    EXPECT_EQ(answer, 42);
}

TEST(Rendering, the_picture_is_the_same_to_the_byte_whatever_the_tiles)
{
    const Shape size{75, 53};
    const unsigned samples = 2 * samples_per_launch + 3;
    const scene::Compiled scene = compiled(size, samples);
    Renderer renderer = make_renderer(find_device(device_selector("")));
    RenderSettings s = settings(size, samples);
    const Frame free = render_frame(renderer, scene, s);
    ASSERT_TRUE(std::any_of(free.picture.rgb.begin(), free.picture.rgb.end(), [](float v) { return v > 0; }));
    for (const auto& [tile, in_flight] : {std::pair{Shape{75, 53}, 1U}, {{1, 1}, 3U}, {{33, 20}, 2U}}) {
        s.tile = tile;
        s.in_flight = in_flight;
        const Frame cut = render_frame(renderer, scene, s);
        EXPECT_EQ(cut.picture.rgb, free.picture.rgb) << tile.width << 'x' << tile.height;
        for (const StatisticsField& f : statistics_fields())
            EXPECT_EQ(cut.statistics.*f.value, free.statistics.*f.value) << f.name;
    }
    EXPECT_EQ(free.statistics.primary, std::uint64_t{75} * 53 * samples);
}

/// Collects bands, which must come in order.
struct Bands {
    std::vector<float> rgb;
    unsigned begun = 0;
    std::function<void(unsigned, std::span<const float>)> taker(unsigned width)
    {
        return [this, width](unsigned y, std::span<const float> band) {
            if (y == 0) {
                rgb.clear();
                ++begun;
            }
            ASSERT_EQ(rgb.size(), std::size_t{3} * width * y);
            rgb.insert(rgb.end(), band.begin(), band.end());
        };
    }
};

TEST(Rendering, rows_are_handed_over_in_order_and_are_those_of_the_whole_picture)
{
    const Shape size{75, 53};
    const unsigned samples = samples_per_launch + 1;
    const scene::Compiled scene = compiled(size, samples);
    Renderer renderer = make_renderer(find_device(device_selector("")));
    RenderSettings s = settings(size, samples);
    const Frame whole = render_frame(renderer, scene, s);
    for (const auto& [tile, in_flight] : {std::pair{Shape{75, 53}, 1U}, {{1, 1}, 3U}, {{33, 20}, 2U}, {{80, 8}, 5U}}) {
        s.tile = tile;
        s.in_flight = in_flight;
        Bands bands;
        const Frame cut = render_frame(renderer, scene, s, {.rows = bands.taker(size.width)});
        EXPECT_EQ(bands.rgb, whole.picture.rgb) << tile.width << 'x' << tile.height;
        EXPECT_EQ(bands.begun, 1U);
        EXPECT_EQ(cut.picture.width, size.width);
        EXPECT_TRUE(cut.picture.rgb.empty());
    }
}

TEST(Rendering, rows_begin_anew_when_a_capacity_was_too_small)
{
    const Shape size{64, 48};
    scene::Compiled scene = compiled(size, 1);
    Renderer renderer = make_renderer(find_device(device_selector("")));
    RenderSettings s = settings(size, 1);
    s.kernel = KernelShape::pixels;
    s.tile = Shape{16, 16};
    const Frame right = render_frame(renderer, scene, s);
    scene.needs.stack = 1;
    Bands bands;
    const Frame frame = render_frame(renderer, scene, s, {.rows = bands.taker(size.width)});
    EXPECT_GT(frame.retries, 0U);
    EXPECT_EQ(bands.begun, frame.retries + 1);
    EXPECT_EQ(bands.rgb, right.picture.rgb);
}

TEST(Rendering, a_second_frame_of_the_same_needs_is_not_compiled_again)
{
    const Shape size{16, 16};
    Renderer renderer = make_renderer(find_device(device_selector("")));
    EXPECT_GT(render_frame(renderer, compiled(size, 1), settings(size, 1)).timings.build, 0);
    EXPECT_EQ(render_frame(renderer, compiled(size, 2), settings(size, 2)).timings.build, 0);
}

TEST(Rendering, a_capacity_that_is_too_small_is_enlarged)
{
    const Shape size{64, 48};
    scene::Compiled scene = compiled(size, 1);
    Renderer renderer = make_renderer(find_device(device_selector("")));
    RenderSettings s = settings(size, 1);
    for (const KernelShape kernel : {KernelShape::pixels, KernelShape::packets}) {
        s.kernel = kernel;
        const Frame right = render_frame(renderer, scene, s);
        scene::Compiled lacking = compiled(size, 1);
        lacking.needs.stack = kernel == KernelShape::pixels ? 1 : 0; // a block's stacks have room for some rays more
        lacking.needs.interior = 1;
        const Frame frame = render_frame(renderer, lacking, s);
        EXPECT_GT(frame.retries, 0U);
        EXPECT_EQ(frame.statistics.stack_overflow + frame.statistics.interior_overflow, 0U);
        EXPECT_EQ(frame.picture.rgb, right.picture.rgb);
    }
}

TEST(Rendering, workarounds_change_nothing_but_the_launches)
{
    const Shape size{64, 48};
    const scene::Compiled scene = compiled(size, 3);
    Device device = find_device(device_selector(""));
    RenderSettings s = settings(size, 3);
    s.kernel = KernelShape::pixels;
    s.tile = size;
    Renderer usual = make_renderer(device);
    const Frame right = render_frame(usual, scene, s);
    device.info.has_fma = false;
    Renderer limited = make_renderer(device);
    const Frame frame = render_frame(limited, scene, s);
    EXPECT_EQ(frame.picture.rgb, right.picture.rgb);
    EXPECT_EQ(frame.statistics.stuck, 0U);
    EXPECT_EQ(right.launches, 1U);
    EXPECT_EQ(frame.launches, 3U);
    EXPECT_GT(frame.statistics.full, right.statistics.full) << "the full search alone";
}

TEST(Rendering, packets_draw_the_same_whatever_the_tiles_and_as_pixels_do)
{
    const Shape size{150, 100};
    const scene::Compiled scene = compiled(size, 20);
    Renderer renderer = make_renderer(find_device(device_selector("")));
    RenderSettings s = settings(size, 20);
    s.kernel = KernelShape::packets;
    const Frame whole = render_frame(renderer, scene, s);
    for (const Shape tile : {Shape{1, 1}, Shape{64, 32}, Shape{96, 200}}) {
        s.tile = tile;
        const Frame frame = render_frame(renderer, scene, s);
        EXPECT_EQ(frame.kernel, KernelShape::packets);
        EXPECT_EQ(frame.picture.rgb, whole.picture.rgb) << tile.width << "x" << tile.height;
    }
    s.kernel = KernelShape::pixels;
    const Frame pixels = render_frame(renderer, scene, s);
    EXPECT_EQ(pixels.kernel, KernelShape::pixels);
    EXPECT_EQ(pixels.statistics.rays, whole.statistics.rays);
    EXPECT_EQ(pixels.statistics.shadow, whole.statistics.shadow);
    double most = 0;
    for (std::size_t i = 0; i < whole.picture.rgb.size(); ++i)
        most = std::max(most, std::fabs(static_cast<double>(whole.picture.rgb[i]) - pixels.picture.rgb[i]));
    EXPECT_LT(most, 1e-5);
}

TEST(Rendering, the_kernel_is_the_one_made_for_the_device_and_the_scene)
{
    DeviceInfo device;
    device.kind = DeviceKind::cpu;
    device.float_lanes = 8;
    EXPECT_EQ(kernel_shape(device, 100), KernelShape::packets);
    EXPECT_EQ(kernel_shape(device, 1000000), KernelShape::pixels);
    device.float_lanes = 4;
    EXPECT_EQ(kernel_shape(device, 100), KernelShape::pixels);
    device.float_lanes = 16;
    device.has_fma = false;
    EXPECT_EQ(kernel_shape(device, 100), KernelShape::pixels) << "its compiler is not up to packets";
    device.has_fma = true;
    device.kind = DeviceKind::gpu;
    EXPECT_EQ(kernel_shape(device, 100), KernelShape::pixels);
}

TEST(Rendering, progress_is_told_and_reaches_the_end)
{
    const Shape size{64, 64};
    Renderer renderer = make_renderer(find_device(device_selector("")));
    RenderSettings s = settings(size, 1);
    s.tile = Shape{32, 32};
    std::vector<double> told;
    render_frame(renderer, compiled(size, 1), s, {[&](double f) { told.push_back(f); }, {}});
    EXPECT_EQ(told.size(), 4U);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 1);
}

TEST(Rendering, a_wish_to_stop_is_heard_between_launches)
{
    const Shape size{64, 64};
    Renderer renderer = make_renderer(find_device(device_selector("")));
    RenderSettings s = settings(size, 1);
    s.tile = Shape{16, 16};
    double done = 0;
    EXPECT_THROW(render_frame(renderer, compiled(size, 1), s, {[&](double f) { done = f; }, [&] { return done > 0; }}),
                 Interrupted);
    EXPECT_LT(done, 0.5);
}

} // namespace
} // namespace clucida::host
