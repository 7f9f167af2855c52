// Plots: ticks, places on axes, colours of series, text that XML allows.
#include "bench/plot.h"
#include "bench/plot_axis.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace clucida::bench {
namespace {

TEST(Axis, has_steps_of_1_2_and_5)
{
    EXPECT_DOUBLE_EQ(nice_step(10, 5), 2);
    EXPECT_DOUBLE_EQ(nice_step(0.9, 5), 0.2);
    EXPECT_DOUBLE_EQ(nice_step(31, 6), 10);
}

TEST(Axis, holds_all_values_and_not_too_many_ticks)
{
    for (const double least : {1e-6, 0.02, 1.0, 40.0})
        for (const double factor : {1.0, 1.01, 3.0, 100.0, 1e7})
            for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
                const AxisRange range(scale, {least * factor, least});
                EXPECT_GE(range.place(least), -1e-9) << least << ' ' << factor;
                EXPECT_LE(range.place(least * factor), 1 + 1e-9) << least << ' ' << factor;
                EXPECT_FALSE(range.ticks().empty());
                EXPECT_LE(range.ticks().size(), 8U) << least << ' ' << factor;
                EXPECT_TRUE(std::ranges::is_sorted(range.ticks()));
                for (const double tick : range.ticks()) {
                    EXPECT_GE(range.place(tick), -1e-9);
                    EXPECT_LE(range.place(tick), 1 + 1e-9);
                }
            }
}

TEST(Axis, writes_numbers_briefly)
{
    EXPECT_EQ(tick_text(0.001), "0.001");
    EXPECT_EQ(tick_text(20000), "20k");
    EXPECT_EQ(tick_text(2e6), "2M");
    EXPECT_EQ(tick_text(0), "0");
}

TEST(Plot, gives_series_of_one_name_one_colour)
{
    SeriesStyles styles;
    EXPECT_EQ(styles.of("a"), 0U);
    EXPECT_EQ(styles.of("b"), 1U);
    EXPECT_EQ(styles.of("a"), 0U);
}

TEST(Plot, leaves_out_what_a_logarithm_does_not_know)
{
    SeriesStyles styles;
    const Plot plot{"t", {"x", Scale::logarithmic}, {"y", Scale::logarithmic}, {{"s", {{0, 1}, {1, 2}, {2, 0}}}}};
    const std::string svg = svg_of(plot, styles, true);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(svg.find("<polyline"), std::string::npos); // of one point
}

TEST(Plot, escapes_what_names_hold)
{
    EXPECT_EQ(xml_text("a<b>&\"\x01"), "a&lt;b&gt;&amp;&quot;");
    SeriesStyles styles;
    const std::string svg = svg_of(Plot{"a & b", {"x"}, {"y"}, {{"<s>", {{1, 2}}}}}, styles, false);
    EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
    EXPECT_NE(svg.find("&lt;s&gt;"), std::string::npos);
}

} // namespace
} // namespace clucida::bench
