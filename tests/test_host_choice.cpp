#include "host/arguments.h"
#include "host/device_choice.h"
#include "host/errors.h"
#include "host/program.h"
#include "host/tiling.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clucida::host {
namespace {

DeviceInfo make(unsigned p, unsigned d, const char* platform, const char* name, DeviceKind kind)
{
    DeviceInfo i;
    i.platform = p;
    i.device = d;
    i.platform_name = platform;
    i.name = name;
    i.kind = kind;
    return i;
}

/// A processor, two cards of one maker, an accelerator.
std::vector<DeviceInfo> some_devices()
{
    auto all = std::vector{
        make(0, 0, "Processors", "pthread-Zen", DeviceKind::cpu), make(2, 0, "Cards", "Big Card", DeviceKind::gpu),
        make(2, 1, "Cards", "Small Card", DeviceKind::gpu), make(3, 0, "Odd", "Thing", DeviceKind::other)};
    all[0].vendor = "Maker of Processors";
    return all;
}

std::string message(std::span<const DeviceInfo> devices, const char* selector)
{
    try {
        choose_device(devices, selector);
    } catch (const std::exception& e) {
        return e.what();
    }
    return {};
}

TEST(DeviceChoice, the_default_is_the_first_gpu_else_the_first_cpu_else_anything)
{
    auto devices = some_devices();
    EXPECT_EQ(choose_device(devices, ""), 1U);
    devices.erase(devices.begin() + 1, devices.begin() + 3);
    EXPECT_EQ(choose_device(devices, ""), 0U);
    devices.erase(devices.begin());
    EXPECT_EQ(choose_device(devices, ""), 0U);
}

TEST(DeviceChoice, a_pair_of_numbers_names_platform_and_device)
{
    EXPECT_EQ(choose_device(some_devices(), "2:1"), 2U);
    EXPECT_THROW(choose_device(some_devices(), "1:0"), Failure);
    EXPECT_THROW(choose_device(some_devices(), "2:"), Failure);
    EXPECT_THROW(choose_device(some_devices(), "2:1x"), Failure);
}

TEST(DeviceChoice, a_part_of_a_name_finds_device_platform_or_vendor_whatever_the_case)
{
    EXPECT_EQ(choose_device(some_devices(), "SMALL"), 2U);
    EXPECT_EQ(choose_device(some_devices(), "odd"), 3U);
    EXPECT_EQ(choose_device(some_devices(), "maker of"), 0U);
}

TEST(DeviceChoice, cpu_and_gpu_name_the_first_of_their_kind)
{
    EXPECT_EQ(choose_device(some_devices(), "cpu"), 0U);
    EXPECT_EQ(choose_device(some_devices(), "GPU"), 1U);
}

TEST(DeviceChoice, an_unknown_name_is_an_error_that_lists_what_there_is)
{
    const std::string text = message(some_devices(), "nothing");
    EXPECT_NE(text.find("2:1 Small Card (Cards)"), std::string::npos) << text;
    EXPECT_NE(text.find("3:0 Thing (Odd)"), std::string::npos) << text;
}

TEST(DeviceChoice, an_ambiguous_name_is_an_error_that_lists_the_matches)
{
    const std::string text = message(some_devices(), "card");
    EXPECT_NE(text.find("2:0 Big Card"), std::string::npos) << text;
    EXPECT_EQ(text.find("Thing"), std::string::npos) << text;
}

TEST(DeviceChoice, all_gives_all_but_one_picture_takes_one)
{
    EXPECT_EQ(choose_devices(some_devices(), "all").size(), 4U);
    EXPECT_THROW(choose_device(some_devices(), "all"), UsageError);
}

TEST(DeviceChoice, no_device_is_a_failure_that_says_what_to_install)
{
    EXPECT_NE(message({}, "").find("pocl-opencl-icd"), std::string::npos);
    EXPECT_NE(message({}, "gpu").find("pocl-opencl-icd"), std::string::npos);
}

TEST(DeviceChoice, a_device_that_cannot_be_used_is_never_chosen)
{
    auto devices = some_devices();
    devices[1].usable = false;
    EXPECT_EQ(choose_device(devices, ""), 2U);
    EXPECT_THROW(choose_device(devices, "2:0"), Failure);
}

TEST(DeviceChoice, double_precision_is_refused_where_the_device_has_none)
{
    DeviceInfo device;
    EXPECT_THROW(variant_options({}, Precision::twofold, device), Failure);
    EXPECT_EQ(variant_options({}, Precision::single, device).find("DOUBLE"), std::string::npos);
    device.has_double = true;
    EXPECT_NE(variant_options({}, Precision::twofold, device).find("-DCLU_DOUBLE"), std::string::npos);
}

TEST(DeviceChoice, exact_division_is_asked_for_where_the_device_has_it_and_fast_mathematics_never)
{
    DeviceInfo device;
    EXPECT_EQ(base_options(device), "-cl-std=CL1.2");
    device.rounds_division = true;
    EXPECT_EQ(base_options(device), "-cl-std=CL1.2 -cl-fp32-correctly-rounded-divide-sqrt");
}

TEST(Arguments, a_picture_has_from_1_to_65536_pixels_a_side_and_2_to_the_30_in_all)
{
    EXPECT_EQ(parse_picture_size("1x65536"), (Shape{1, 65536}));
    EXPECT_EQ(parse_picture_size("32768x32768"), (Shape{32768, 32768}));
    for (const char* wrong : {"", "x", "10", "10x", "x10", "0x0", "0x5", "-1x5", "+1x5", "1.5x2", "1x2x3", " 1x2",
                              "1x2 ", "65537x1", "1000000x1000000", "99999999999x1", "65536x32768"})
        EXPECT_THROW(parse_picture_size(wrong), UsageError) << wrong;
}

TEST(Tiling, a_group_fits_what_device_and_kernel_can_take)
{
    EXPECT_EQ(choose_group(4096), (Shape{16, 4}));
    for (std::size_t most = 1; most <= 64; ++most) EXPECT_LE(area(choose_group(most)), most);
    EXPECT_EQ(area(choose_group(32)), 32U);
    EXPECT_EQ(area(choose_group(1)), 1U);
}

TEST(Tiling, a_tile_is_whole_groups_within_budget_and_memory)
{
    const Shape picture{1920, 1080}, group{16, 4};
    for (int power = -9; power < 1; ++power) {
        const double seconds = 0.7 * std::pow(10, power);
        const Shape tile = choose_tile(picture, group, seconds, {});
        EXPECT_EQ(tile.width % group.width, 0U);
        EXPECT_EQ(tile.height % group.height, 0U);
        EXPECT_LE(area(tile), std::size_t{1} << 20);
        EXPECT_TRUE(tile == group || static_cast<double>(area(tile)) * seconds <= 0.25) << seconds;
    }
    EXPECT_EQ(choose_tile({100, 50}, group, 1e-7, {}), (Shape{112, 52}));
    EXPECT_EQ(choose_tile({1, 1}, group, 0, {}), group);
}

TEST(Tiling, a_row_of_tiles_of_a_wide_picture_keeps_within_memory)
{
    const TileLimits limits;
    for (const unsigned width : {4096U, 16384U, 65536U})
        for (const double seconds : {0.0, 1e-8, 1e-6}) {
            const Shape group{16, 4}, tile = choose_tile({width, 16384}, group, seconds, limits);
            EXPECT_LE(std::size_t{width} * tile.height, limits.band_pixels);
            EXPECT_LE(area(tile), limits.pixels);
            EXPECT_GE(area(tile), std::min(1.0, 0.25 / seconds / limits.pixels) * limits.pixels * 0.9) << width;
        }
    EXPECT_EQ(choose_tile({65536, 16384}, {16, 4}, 0, {.band_pixels = 1}).height, 4U);
}

TEST(Tiling, tiles_cover_every_pixel_once)
{
    const Tiling tiling{{37, 23}, {16, 8}};
    std::vector<int> seen(std::size_t{37} * 23);
    for (std::size_t i = 0; i < tiling.count(); ++i)
        for (unsigned y = 0; y < tiling.visible(i).height; ++y)
            for (unsigned x = 0; x < tiling.visible(i).width; ++x)
                ++seen[std::size_t{37} * (tiling.y0(i) + y) + tiling.x0(i) + x];
    for (const int n : seen) ASSERT_EQ(n, 1);
}

} // namespace
} // namespace clucida::host
