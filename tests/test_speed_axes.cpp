// The contenders of a race as a product of what the command line lists.
#include "bench/speed_axes.h"
#include "host/errors.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace clucida::bench {
namespace {

host::DeviceInfo cpu()
{
    host::DeviceInfo out;
    out.kind = host::DeviceKind::cpu;
    out.float_lanes = 8;
    return out;
}

host::DeviceInfo gpu()
{
    host::DeviceInfo out;
    out.platform = 1;
    out.kind = host::DeviceKind::gpu;
    return out;
}

TEST(SpeedAxes, are_multiplied)
{
    SpeedAxes axes;
    axes.devices = {cpu(), gpu()};
    axes.precisions = {host::Precision::single, host::Precision::twofold};
    axes.samples = {1, 4, 16};
    axes.max_hops = {4, std::nullopt};
    axes.cutoffs = {std::nullopt, 0.01};
    axes.pictures = {{32, 18}, {64, 36}};
    const std::vector<SpeedContender> all = contenders_of(axes);
    EXPECT_EQ(all.size(), 2U * 2 * 3 * 2 * 2 * 2);
    for (const SpeedContender& c : all) EXPECT_EQ(std::ranges::count(all, c), 1);
}

TEST(SpeedAxes, have_no_limit_of_threads_for_what_has_none)
{
    SpeedAxes axes;
    axes.devices = {cpu(), gpu()};
    axes.threads = {1, 2, 0};
    EXPECT_EQ(contenders_of(axes).size(), 3U + 1);
    axes.native = true;
    EXPECT_EQ(contenders_of(axes).size(), 3U + 1 + 3);
}

TEST(SpeedAxes, have_local_sizes_for_the_kernel_of_pixels_only)
{
    SpeedAxes axes;
    axes.devices = {cpu()};
    axes.groups = {std::nullopt, host::Shape{8, 8}};
    axes.kernels = {host::KernelShape::packets};
    EXPECT_EQ(contenders_of(axes).size(), 1U);
    axes.kernels = {host::KernelShape::pixels, host::KernelShape::packets};
    EXPECT_EQ(contenders_of(axes).size(), 2U + 1);
    axes.devices = {gpu()};
    axes.kernels = {std::nullopt}; // which are pixels there
    EXPECT_EQ(contenders_of(axes).size(), 2U);
}

TEST(SpeedAxes, refuse_absurdly_many)
{
    SpeedAxes axes;
    axes.devices = {cpu()};
    axes.samples.resize(1001, 1);
    EXPECT_THROW(contenders_of(axes), host::UsageError);
    axes.samples = {1};
    axes.threads.resize(65, 1);
    EXPECT_THROW(contenders_of(axes), host::UsageError);
}

TEST(SpeedAxes, know_their_words)
{
    EXPECT_EQ(parse_thread_limit("all"), 0U);
    EXPECT_EQ(parse_thread_limit("3"), 3U);
    EXPECT_EQ(parse_max_hops("scene"), std::nullopt);
    EXPECT_EQ(parse_cutoff("0.25"), 0.25);
    EXPECT_EQ(parse_local_size("auto"), std::nullopt);
    EXPECT_EQ(parse_local_size("8x4"), (host::Shape{8, 4}));
    EXPECT_EQ(parse_kernel("pixels"), host::KernelShape::pixels);
    for (const char* wrong : {"", "0", "-1", "1.5", "many", "1 "}) EXPECT_THROW(parse_samples(wrong), host::UsageError);
    for (const char* wrong : {"nan", "2", "-0.1", "", "1e"}) EXPECT_THROW(parse_cutoff(wrong), host::UsageError);
    EXPECT_THROW(parse_local_size("8"), host::UsageError);
}

} // namespace
} // namespace clucida::bench
