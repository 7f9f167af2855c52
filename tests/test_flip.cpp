#include "host/errors.h"
#include "host/false_color.h"
#include "host/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clucida::host {
namespace {

constexpr unsigned width = 48, height = 32;

template <typename Value>
Picture picture(Value value)
{
    Picture p = make_picture(width, height);
    for (unsigned i = 0; i < p.rgb.size(); ++i) p.rgb[i] = value(i / 3 % width, i / 3 / width, i % 3);
    return p;
}

Picture uniform(float r, float g, float b)
{
    return picture([&](unsigned, unsigned, unsigned c) { return c == 0 ? r : c == 1 ? g : b; });
}

/// Rough, with many colours.
Picture pattern(unsigned seed)
{
    return picture([seed](unsigned x, unsigned y, unsigned c) {
        return static_cast<float>((x * x * 3 + y * y * 5 + x * y * seed + c * 11) / 16 % 17) / 16;
    });
}

/// Ramps with an edge here and there, moved to the left.
Picture ramps(unsigned shift)
{
    return picture([shift](unsigned x, unsigned y, unsigned c) {
        return static_cast<float>(((x + shift) * (c + 1) + y * (3 - c)) % 64) / 64;
    });
}

struct Expected {
    Picture a, b;
    double pixels_per_degree, mean, at_0_0, at_20_13, at_47_31;
};

// The expected values are those of the authors' own program: flip-evaluator 1.7 of the Python Package Index,
// evaluate(a, b, "LDR", inputsRGB=False, applyMagma=False), the mean taken in double over its map. Both programs work
// in float, and where features are faint the square root makes their roundings show: on rendered pictures each is up to
// 6e-5 from the same computed in double.
constexpr double rounding = 1e-4;

TEST(Flip, it_gives_what_the_authors_program_gives)
{
    const double usual = flip_pixels_per_degree;
    for (const Expected& e :
         {Expected{pattern(2), pattern(7), usual, 0.317258, 0.068612, 0.442610, 0.273971},
          Expected{pattern(2), pattern(7), 30, 0.585611, 0.007415, 0.680537, 0.442923},
          Expected{ramps(0), ramps(2), usual, 0.424405, 0.477844, 0.536779, 0.239402},
          Expected{ramps(0), ramps(2), 20, 0.433919, 0.655597, 0.644605, 0.192360},
          Expected{uniform(0, 0, 0), uniform(1, 1, 1), usual, 0.967388, 0.967388, 0.967388, 0.967388},
          Expected{uniform(1, 0, 0), uniform(1, 1, 0), usual, 0.977157, 0.977157, 0.977157, 0.977157},
          Expected{uniform(.5F, .5F, .5F), uniform(.51F, .51F, .51F), usual, 0.040722, 0.040722, 0.040722, 0.040722}}) {
        SCOPED_TRACE(e.mean);
        const Flip f = flip(e.a, e.b, e.pixels_per_degree);
        ASSERT_EQ(f.error.value.size(), std::size_t{width} * height);
        EXPECT_NEAR(f.mean, e.mean, rounding);
        EXPECT_NEAR(f.error.value[0], e.at_0_0, rounding);
        EXPECT_NEAR(f.error.value[13 * width + 20], e.at_20_13, rounding);
        EXPECT_NEAR(f.error.value[31 * width + 47], e.at_47_31, rounding);
    }
}

TEST(Flip, equal_pictures_have_none)
{
    const Flip f = flip(pattern(3), pattern(3));
    EXPECT_EQ(f.mean, 0);
    EXPECT_EQ(f.error.value, make_plane(width, height).value);
}

TEST(Flip, the_order_of_the_pictures_changes_nothing)
{
    EXPECT_EQ(flip(pattern(2), ramps(0)).error.value, flip(ramps(0), pattern(2)).error.value);
}

TEST(Flip, it_lies_within_0_and_1_and_green_against_blue_is_the_most_there_is)
{
    for (const double pixels_per_degree : {1.0, 5.0, 67.0, 1000.0}) {
        const Flip f = flip(pattern(2), ramps(0), pixels_per_degree);
        for (const float v : f.error.value) ASSERT_TRUE(v >= 0 && v <= 1) << v << ' ' << pixels_per_degree;
        EXPECT_GT(f.mean, 0);
    }
    EXPECT_NEAR(flip(uniform(0, 1, 0), uniform(0, 0, 1)).mean, 1, 1e-6);
}

/// Uniform pictures have no features and stay as they are when blurred. Black and white lie 100 apart; green and blue
/// are the colours farthest apart: here by their L*a*b* to two decimals.
TEST(Flip, black_against_white_is_what_the_formula_says)
{
    const double green[] = {87.73, -86.18, 83.18}, blue[] = {32.30, 79.19, -107.86};
    const auto hunt = [&](int i) { return 0.01 * (green[0] * green[i] - blue[0] * blue[i]); };
    const double all = std::pow(green[0] - blue[0] + std::hypot(hunt(1), hunt(2)), 0.7), knee = 0.4 * all;
    const double expected = 0.95 + (std::pow(100, 0.7) - knee) / (all - knee) * 0.05;
    EXPECT_NEAR(flip(uniform(0, 0, 0), uniform(1, 1, 1)).mean, expected, 1e-4);
}

TEST(Flip, a_larger_shift_is_a_larger_error)
{
    double last = 0;
    for (const unsigned shift : {1U, 2U, 4U, 8U}) {
        const double mean = flip(ramps(0), ramps(shift)).mean;
        EXPECT_GT(mean, last * 1.1) << shift;
        last = mean;
    }
}

TEST(Flip, fine_detail_counts_less_from_afar)
{
    const Picture grey = uniform(0.5F, 0.5F, 0.5F);
    const Picture chess = picture([](unsigned x, unsigned y, unsigned) { return static_cast<float>((x + y) % 2); });
    EXPECT_LT(flip(grey, chess, 120).mean, 0.5 * flip(grey, chess, 10).mean);
}

TEST(Flip, what_lies_beyond_0_and_1_is_clamped_and_what_is_no_number_is_black)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    EXPECT_EQ(flip(uniform(1, 1, 1), uniform(7, infinite, 1)).mean, 0);
    EXPECT_EQ(flip(uniform(0, 0, 0), uniform(-1, -infinite, nan)).mean, 0);
}

TEST(Flip, a_picture_smaller_than_the_filters_is_no_trouble)
{
    Picture a = make_picture(1, 1), b = make_picture(1, 1);
    b.rgb = {1, 1, 1};
    EXPECT_NEAR(flip(a, b).mean, flip(uniform(0, 0, 0), uniform(1, 1, 1)).mean, 1e-5);
    EXPECT_EQ(flip({}, {}).mean, 0);
}

TEST(Flip, other_sizes_and_absurd_conditions_are_refused)
{
    EXPECT_THROW(flip(make_picture(2, 3), make_picture(3, 2)), Failure);
    for (const double ppd : {0.0, -1.0, 1e4, std::nan("")})
        EXPECT_THROW(flip(make_picture(2, 3), make_picture(2, 3), ppd), UsageError) << ppd;
}

double luminance(const std::array<float, 3>& rgb)
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// matplotlib made it even in CAM02-UCS, which departs from L* by 5.6.
TEST(FalseColor, it_grows_lighter_all_the_way_in_about_even_steps)
{
    double last = -1;
    for (int i = 0; i <= 100; ++i) {
        const double y = luminance(magma(i / 100.0)), lightness = y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
        ASSERT_GT(lightness, last) << i;
        ASSERT_NEAR(lightness, 98.0 * i / 100, 6) << i;
        last = lightness;
    }
}

// Colours 100, 150 and 200 of 255 of matplotlib 3.11.2's magma.
TEST(FalseColor, it_is_matplotlibs_magma_but_for_three_steps)
{
    Picture p = make_picture(3, 1);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto color = magma((100 + 50 * static_cast<double>(i)) / 255);
        std::copy(color.begin(), color.end(), p.rgb.begin() + std::ptrdiff_t{3} * i);
    }
    const auto bytes = develop_8(p, Transfer::srgb);
    const int expected[] = {137, 40, 129, 217, 70, 107, 253, 152, 105};
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(bytes[i], expected[i], 3) << i;
}

TEST(FalseColor, a_logarithmic_scale_gives_each_power_of_ten_as_much_room)
{
    const Scale scale{.least = 1e-6, .most = 1, .logarithmic = true};
    for (int e = 0; e <= 6; ++e) EXPECT_NEAR(place_on_scale(std::pow(10, e - 6), scale), e / 6.0, 1e-12);
    for (const double low : {1e-7, 0.0, -1.0}) EXPECT_EQ(place_on_scale(low, scale), 0);
    for (const double high : {2.0, std::numeric_limits<double>::infinity()}) EXPECT_EQ(place_on_scale(high, scale), 1);
    EXPECT_DOUBLE_EQ(place_on_scale(0.25, {}), 0.25);
}

TEST(FalseColor, what_is_no_number_stands_out)
{
    Plane plane = make_plane(2, 1);
    plane.value = {std::numeric_limits<float>::quiet_NaN(), 0};
    const Picture p = false_color(plane, {});
    EXPECT_EQ((std::vector<float>{p.rgb.begin(), p.rgb.begin() + 3}), (std::vector<float>{0, 1, 0}));
    EXPECT_LT(p.rgb[4], 0.01F);
}

TEST(FalseColor, the_legend_lies_beneath_and_shows_every_colour)
{
    for (const unsigned w : {1U, 2U, 5U, 640U}) {
        Picture p = make_picture(w, 3);
        for (float& v : p.rgb) v = 0.25F;
        const Picture q = with_legend(p, {.least = 1e-6, .most = 1, .logarithmic = true});
        ASSERT_EQ(q.width, w);
        ASSERT_GT(q.height, p.height);
        ASSERT_EQ(q.rgb.size(), std::size_t{3} * q.width * q.height);
        EXPECT_TRUE(std::equal(p.rgb.begin(), p.rgb.end(), q.rgb.begin()));
        for (const unsigned x : {0U, w - 1}) {
            const float* color = q.rgb.data() + std::size_t{3} * (w * std::size_t{p.height + 4} + x);
            const auto expected = magma(x ? 1 : 0);
            EXPECT_TRUE(std::equal(expected.begin(), expected.end(), color)) << w << ' ' << x;
        }
        const bool labels = std::find(q.rgb.end() - std::ptrdiff_t{3} * 10 * w, q.rgb.end(), 1.0F) != q.rgb.end();
        EXPECT_EQ(labels, w > 5) << "there is no room for one in " << w << " pixels";
    }
}

} // namespace
} // namespace clucida::host
