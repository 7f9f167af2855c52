/// Halves as they would be stored.
#include "bench/half_storage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clucida::bench {
namespace {

TEST(HalfStorage, knows_the_halves_of_the_standard)
{
    const std::pair<double, unsigned> expected[] = {
        {0, 0x0000},       {1, 0x3c00},       {-2, 0xc000},      {65504, 0x7bff},
        {0.5, 0x3800},     {0x1p-14, 0x0400}, {0x1p-24, 0x0001}, {1023 * 0x1p-24, 0x03ff},
        {1.0 / 3, 0x3555}, {65520, 0x7c00},   {0x1p-26, 0x0000}};
    for (const auto& [value, bits] : expected) EXPECT_EQ(half_bits(value, Rounding::nearest), bits) << value;
    EXPECT_EQ(half_bits(-std::numeric_limits<double>::infinity(), Rounding::nearest), 0xfc00U);
}

TEST(HalfStorage, gives_back_every_half)
{
    for (unsigned bits = 0; bits < 0x10000; ++bits) {
        const double value = half_value(static_cast<std::uint16_t>(bits));
        if (std::isnan(value)) continue;
        for (const Rounding r : {Rounding::nearest, Rounding::down, Rounding::up})
            ASSERT_EQ(half_bits(value, r), bits) << value;
    }
}

TEST(HalfStorage, rounds_to_the_side_that_is_asked_for)
{
    for (double v = -70000; v < 70000; v = v * (v < 0 ? 0.97 : 1.03) + 1e-4) {
        const double low = half_value(half_bits(v, Rounding::down)), high = half_value(half_bits(v, Rounding::up));
        ASSERT_LE(low, v);
        ASSERT_GE(high, v);
        const double nearest = half_value(half_bits(v, Rounding::nearest));
        ASSERT_TRUE(nearest == low || nearest == high) << v;
    }
}

} // namespace
} // namespace clucida::bench
