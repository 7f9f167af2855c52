#include "host/arguments.h"
#include "host/device_choice.h"
#include "host/errors.h"
#include "host/program.h"
#include "host/tiling.h"

#include <gtest/gtest.h>

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

TEST(DeviceChoice, all_gives_all_where_one_will_not_do)
{
    EXPECT_EQ(choose_devices(some_devices(), "all").size(), 4U);
    EXPECT_THROW(choose_device(some_devices(), "all"), UsageError);
}

TEST(DeviceChoice, a_list_gives_each_once_in_its_order)
{
    EXPECT_EQ(choose_devices(some_devices(), "odd,2:1,gpu,3:0"), (std::vector<std::size_t>{3, 2, 1}));
    EXPECT_THROW(choose_devices(some_devices(), "odd,card"), Failure);
    EXPECT_THROW(choose_devices(some_devices(), "odd,nothing"), Failure);
    for (const char* wrong : {",", "odd,", ",odd", "odd,,gpu"})
        EXPECT_THROW(choose_devices(some_devices(), wrong), UsageError) << wrong;
}

/// With the native device behind.
std::vector<DeviceInfo> with_native(std::vector<DeviceInfo> devices)
{
    devices.push_back(make(0, 0, "native", "Zen of Processors", DeviceKind::cpu));
    devices.back().native = true;
    return devices;
}

TEST(DeviceChoice, the_native_device_is_taken_by_its_name_or_for_want_of_another)
{
    const auto all = with_native(some_devices());
    EXPECT_EQ(choose_device(all, "native"), 4U);
    EXPECT_EQ(choose_device(all, "zen"), 0U) << "a part of its processor's name means OpenCL's device";
    EXPECT_EQ(choose_device(all, "0:0"), 0U);
    EXPECT_EQ(choose_device(all, "cpu"), 0U);
    EXPECT_EQ(choose_devices(all, "all").size(), 4U);
    EXPECT_EQ(choose_devices(all, "native,gpu"), (std::vector<std::size_t>{4, 1}));
    const auto alone = with_native({});
    for (const char* word : {"", "cpu", "all", "native"}) EXPECT_EQ(choose_device(alone, word), 0U) << word;
    EXPECT_NE(message(alone, "gpu").find("--device native"), std::string::npos);
    EXPECT_THROW(choose_device(alone, "zen"), Failure);
    EXPECT_THROW(choose_device(alone, "0:0"), Failure);
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

TEST(Tiling, shapes_are_rounded_up_to_whole_grains)
{
    EXPECT_EQ(round_up({100, 50}, {16, 4}), (Shape{112, 52}));
    EXPECT_EQ(round_up({0, 0}, {16, 4}), (Shape{16, 4}));
    EXPECT_EQ(common_multiple({16, 4}, {32, 6}), (Shape{32, 12}));
}

} // namespace
} // namespace clucida::host
