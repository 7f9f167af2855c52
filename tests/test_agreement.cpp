// How far two pictures are apart, value by value and path by path.
#include "bench/agreement.h"
#include "host/errors.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace clucida::bench {
namespace {

std::uint32_t bits(float x)
{
    return std::bit_cast<std::uint32_t>(x);
}

TEST(Agreement, floats_are_counted_across_zero)
{
    EXPECT_EQ(ulps_between(bits(1), bits(1)), 0U);
    EXPECT_EQ(ulps_between(bits(1), bits(1 + 0x1p-23F)), 1U);
    EXPECT_EQ(ulps_between(bits(0.0F), bits(-0.0F)), 0U);
    EXPECT_EQ(ulps_between(bits(-0x1p-149F), bits(0x1p-149F)), 2U);
    const std::uint32_t none = bits(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(ulps_between(none, none), 0U);
    EXPECT_EQ(ulps_between(none, bits(1)), std::numeric_limits<std::uint32_t>::max());
}

TEST(Agreement, a_flip_and_another_value_on_the_same_path_are_told_apart)
{
    const Render a{std::vector<std::uint32_t>(9, bits(0.5F)), {1, 2, 3}};
    Render b = a;
    b.rgb[0] = bits(0.5F + 0x1p-24F); // the first pixel, on the same path
    b.rgb[4] = bits(1);               // the second, on another
    b.paths[1] = 7;
    const Agreement found = agree(a, b, {3, 1});
    EXPECT_EQ(found.values, 9U);
    EXPECT_EQ(found.equal, 7U);
    EXPECT_EQ(found.pixels, 3U);
    EXPECT_EQ(found.over, 1U);
    EXPECT_EQ(found.flips, 1U);
    EXPECT_EQ(found.other, 1U);
    EXPECT_GT(found.most_steps, 1U);
    EXPECT_EQ(united(found, found).flips, 2U);
    EXPECT_EQ(united(found, found).most_steps, found.most_steps);
    EXPECT_THROW(agree(a, b, {4, 1}), host::Failure);
}

TEST(Agreement, a_place_is_an_environment_and_a_device)
{
    const Place place = parse_place("A=1 B=x=y the device");
    EXPECT_EQ(place.environment, (host::Environment{{"A", "1"}, {"B", "x=y"}}));
    EXPECT_EQ(place.selector, "the device");
    EXPECT_TRUE(parse_place("0:0").environment.empty());
    EXPECT_THROW(parse_place("A=1"), host::UsageError);
}

} // namespace
} // namespace clucida::bench
