// Plots: ticks, places on axes, colours of series, text that XML allows.
#include "bench/html.h"
#include "bench/plot.h"
#include "bench/plot_axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

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

TEST(Axis, of_what_is_counted_has_whole_ticks)
{
    EXPECT_EQ(AxisRange(Scale::logarithmic, {1, 2}).ticks(), (std::vector<double>{1, 2}));
    EXPECT_EQ(AxisRange(Scale::linear, {0, 1, 2}).ticks(), (std::vector<double>{0, 1, 2}));
}

TEST(Axis, writes_numbers_briefly)
{
    EXPECT_EQ(tick_text(0.001), "0.001");
    EXPECT_EQ(tick_text(20000), "20k");
    EXPECT_EQ(tick_text(2e6), "2M");
    EXPECT_EQ(tick_text(0), "0");
}

TEST(Plot, gives_each_device_a_colour_in_all_plots_and_each_setting_a_shape_within_one)
{
    DeviceColors colors;
    EXPECT_EQ(colors.of("a"), 0U);
    EXPECT_EQ(colors.of("b"), 1U);
    EXPECT_EQ(colors.of("a"), 0U);
    const std::vector<PlotPoint> point{{1, 2}};
    const Plot plot{"t", {"x"}, {"y"}, {{{"b", "double"}, point}, {{"a", "double"}, point}, {{"a", "float"}, point}}};
    const std::string svg = svg_of(plot, colors, false);
    for (const char* style : {"c1 s1", "c0 s1", "c0 s0"})
        EXPECT_NE(svg.find(std::string("\"mark ") + style + "\""), std::string::npos) << style;
    EXPECT_EQ(svg.find("c1 s0"), std::string::npos);
}

TEST(Plot, has_a_colour_of_light_and_one_of_dark_for_ten_devices)
{
    DeviceColors colors;
    std::vector<Series> series;
    for (int i = 0; i < 10; ++i) series.push_back({{"device " + std::to_string(i)}, {{1, 2}}});
    const std::string svg = svg_of(Plot{"t", {"x"}, {"y"}, series}, colors, true);
    const std::size_t dark = svg.find("prefers-color-scheme: dark");
    std::set<std::string> seen;
    for (int i = 0; i < 10; ++i) {
        EXPECT_NE(svg.find("class=\"mark c" + std::to_string(i) + " s0\""), std::string::npos) << i;
        const std::string rule = ".c" + std::to_string(i) + " { fill: ";
        const std::size_t first = svg.find(rule), second = svg.find(rule, dark);
        ASSERT_LT(first, dark) << i;
        ASSERT_NE(second, std::string::npos) << i;
        for (const std::size_t at : {first, second}) seen.insert(svg.substr(at + rule.size(), 7));
    }
    EXPECT_EQ(seen.size(), 20U);
}

TEST(Plot, cuts_names_that_are_too_long_for_their_place)
{
    DeviceColors colors;
    const std::string name = "begin" + std::string(200, '-') + "end";
    const std::string points = svg_of(Plot{"t", {"x"}, {"y"}, {{{name}, {{1, 2}}}}}, colors, true);
    const std::string bars = svg_of(BarPlot{"t", "x", {{"a"}}, {{name, {1}, {"1 ms"}}}}, colors, true);
    for (const std::string& svg : {points, bars}) {
        EXPECT_EQ(svg.find(name), std::string::npos);
        EXPECT_NE(svg.find(">begin--"), std::string::npos);
        EXPECT_NE(svg.find("--end<"), std::string::npos);
    }
}

TEST(Plot, leaves_out_what_a_logarithm_does_not_know)
{
    DeviceColors colors;
    const Plot plot{"t", {"x", Scale::logarithmic}, {"y", Scale::logarithmic}, {{{"s"}, {{0, 1}, {1, 2}, {2, 0}}}}};
    const std::string svg = svg_of(plot, colors, true);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(svg.find("<polyline"), std::string::npos); // of one point
}

TEST(Page, has_notes_as_paragraphs_and_lists_with_code)
{
    EXPECT_EQ(html_notes({"By `a<b`.", "- one", "- two"}),
              "<p>By <code>a&lt;b</code>.</p>\n<ul>\n<li>one</li>\n<li>two</li>\n</ul>\n");
}

TEST(Plot, escapes_what_names_hold)
{
    EXPECT_EQ(xml_text("a<b>&\"\x01"), "a&lt;b&gt;&amp;&quot;");
    DeviceColors colors;
    const std::string svg = svg_of(Plot{"a & b", {"x"}, {"y"}, {{{"<s>"}, {{1, 2}}}}}, colors, false);
    EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
    EXPECT_NE(svg.find("&lt;s&gt;"), std::string::npos);
}

} // namespace
} // namespace clucida::bench
