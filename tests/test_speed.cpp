// What `clucida-bench speed` computes with: pixels on a grid, quartiles, tasks as JSON, the native build.
#include "bench/native_library.h"
#include "bench/speed_error.h"
#include "bench/speed_task.h"
#include "bench/spread.h"
#include "bench/temporary_folder.h"
#include "host/atomic_file.h"
#include "host/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>

namespace clucida::bench {
namespace {

TEST(GridPixels, are_no_more_than_asked_for_and_reach_over_the_whole_picture)
{
    for (const host::Shape picture : {host::Shape{640, 360}, {1000, 1}, {1, 77}, {3, 2}, {1, 1}})
        for (const std::size_t most : {1U, 7U, 100U, 1000U}) {
            const std::vector<std::size_t> pixels = grid_pixels(picture, most);
            ASSERT_FALSE(pixels.empty());
            EXPECT_LE(pixels.size(), most);
            EXPECT_GE(4 * pixels.size() + 4, std::min(most, host::area(picture))); // a step's rounding loses some
            EXPECT_EQ(std::set(pixels.begin(), pixels.end()).size(), pixels.size());
            EXPECT_LT(pixels.back(), host::area(picture));
            if (most < 100) continue;
            EXPECT_GE(pixels.back() + 1, host::area(picture) * 3 / 4);
        }
}

TEST(GridPixels, are_all_pixels_where_so_many_are_allowed)
{
    EXPECT_EQ(grid_pixels({3, 2}, 6), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

TEST(Spread, is_that_of_the_middle_half)
{
    EXPECT_EQ(quantile({4, 1, 3, 2, 5}, 0.5), 3);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
    EXPECT_EQ(interquartile_range({1, 2, 3, 4, 1000}), 2);
    EXPECT_EQ(interquartile_range({7}), 0);
}

TEST(SpeedTask, comes_back_from_json_as_it_was)
{
    SpeedTask task;
    task.scene = {"a b.gun", "gun", "/folder", true};
    task.contender = {"1:2", host::Precision::twofold, 3, host::KernelShape::packets, host::Shape{8, 4}};
    task.contender.view = {{12, 34}, 5, {}, 0.125};
    task.native = {"cc", "haswell", "/tmp/folder"};
    task.least_stack = 64;
    const nlohmann::ordered_json j = to_json(task);
    EXPECT_EQ(to_json(task_of(j)), j);
    EXPECT_EQ(task_of(j).contender, task.contender);
}

/// A compiler that does not optimize, which takes most of the time.
std::string quick_compiler(const std::filesystem::path& folder)
{
    const std::filesystem::path file = folder / "compiler";
    host::write_file(file, "#!/bin/sh\nexec \"$(command -v clang || command -v cc)\" \"$@\" -O0\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file.string();
}

TEST(NativeLibrary, compiles_with_every_feature_alone)
{
    const TemporaryFolder folder;
    const NativeBuild build{quick_compiler(folder.path()), "native", folder.path()};
    for (const scene::FeatureName& feature : scene::feature_names()) {
        const scene::Needs needs{feature.feature, 1, 0, 1};
        for (const host::KernelShape kernel : {host::KernelShape::pixels, host::KernelShape::packets})
            EXPECT_NE(native_library(build, needs, host::Precision::single, kernel).render, nullptr) << feature.name;
    }
    EXPECT_NE(native_library(build, {0, 4, 8, 2}, host::Precision::twofold, host::KernelShape::pixels).render, nullptr);
}

TEST(NativeLibrary, is_compiled_once_for_the_same_needs)
{
    const TemporaryFolder folder;
    const scene::Needs needs{scene::feature_sphere, 1, 0, 1};
    const auto pixels = host::KernelShape::pixels;
    native_library({"", "native", folder.path()}, needs, host::Precision::single, pixels);
    EXPECT_NE(native_library({"false", "native", folder.path()}, needs, host::Precision::single, pixels).render,
              nullptr);
    EXPECT_THROW(native_library({"false", "native", folder.path()}, needs, host::Precision::twofold, pixels),
                 host::Failure);
}

} // namespace
} // namespace clucida::bench
