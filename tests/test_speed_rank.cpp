// What is made of figures: ranks, the front, recommendations, reports beside each other.
#include "bench/compare_reports.h"
#include "bench/recommendations.h"
#include "bench/speed_calibration.h"
#include "bench/speed_rank.h"
#include "host/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace clucida::bench {
namespace {

using Json = nlohmann::ordered_json;

SpeedReport report(unsigned samples, double seconds, double rmse)
{
    SpeedReport out;
    out.contender = {"0:0"};
    out.contender.view.samples = samples;
    out.real = {seconds};
    out.settings = host::Comparison{};
    out.settings->rmse = rmse;
    return out;
}

/// Two samples are slower than four and worse.
SceneSpeed scene()
{
    SceneSpeed out;
    out.name = out.file = "a.clu";
    out.hash = "digest";
    out.reports = {report(16, 4, 0.01), report(1, 1, 0.1), report(2, 3, 0.06), report(4, 2, 0.05)};
    return out;
}

std::vector<unsigned> samples_of(const std::vector<Ranked>& all)
{
    std::vector<unsigned> out;
    for (const Ranked& r : all) out.push_back(r.report->contender.view.samples);
    return out;
}

TEST(Rank, has_the_fastest_first)
{
    const SceneSpeed speed = scene();
    EXPECT_EQ(samples_of(ranked(speed)), (std::vector<unsigned>{1, 4, 2, 16}));
}

TEST(Rank, has_on_the_front_what_none_betters_in_time_and_error)
{
    const SceneSpeed speed = scene();
    std::vector<bool> front;
    for (const Ranked& r : ranked(speed)) front.push_back(r.on_front);
    EXPECT_EQ(front, (std::vector<bool>{true, true, false, true}));
}

TEST(Rank, has_a_front_for_each_size)
{
    SceneSpeed speed = scene();
    speed.reports.push_back(report(1, 0.5, 0.2));
    speed.reports.back().contender.view.picture = {64, 36};
    const std::vector<Ranked> all = ranked(speed);
    EXPECT_EQ(all.front().report->contender.view.picture, (host::Shape{64, 36}));
    EXPECT_TRUE(all.front().on_front);
    EXPECT_TRUE(all[1].on_front);
}

TEST(Rank, leaves_out_what_failed)
{
    SceneSpeed speed = scene();
    speed.reports[1].failure = "no such device";
    EXPECT_EQ(samples_of(ranked(speed)), (std::vector<unsigned>{4, 2, 16}));
}

TEST(Recommendation, is_the_fastest_that_suffices)
{
    const SceneSpeed speed = scene();
    const std::vector<Recommendation> found = recommend(speed, 0.05);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found[0].suffices);
    EXPECT_EQ(found[0].report->contender.view.samples, 4U);
    EXPECT_NE(describe(found[0], speed, 0.05)
                  .find("clucida render a.clu --device 0:0 --precision float --samples 4 "
                        "-s 640x360"),
              std::string::npos);
}

TEST(Recommendation, is_the_most_accurate_where_none_suffices)
{
    const SceneSpeed speed = scene();
    const std::vector<Recommendation> found = recommend(speed, 1e-3);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_FALSE(found[0].suffices);
    EXPECT_EQ(found[0].report->contender.view.samples, 16U);
    EXPECT_NE(describe(found[0], speed, 1e-3).find("none has an RMSE of at most 0.001"), std::string::npos);
}

TEST(Recommendation, names_nothing_that_render_has_no_options_for)
{
    SceneSpeed speed = scene();
    speed.reports[1].contender.threads = 1;
    speed.reports[3].contender.device.clear(); // the native build
    EXPECT_EQ(recommend(speed, 1).front().report->contender.view.samples, 2U);
    const Table table = recommendation_table(std::span(&speed, 1), recommended_errors);
    ASSERT_EQ(table.rows.size(), 1U);
    EXPECT_EQ(table.rows[0].back(), "none");
    EXPECT_EQ(table.rows[0].size(), table.head.size());
}

TEST(Calibration, is_made_of_reports_that_render_can_repeat)
{
    SceneSpeed speed = scene();
    speed.reports[0].contender.threads = 1;
    speed.reports[1].failure = "broken";
    speed.reports[2].settings.reset();
    const std::vector<host::CalibrationRecord> found = records_of(std::span(&speed, 1), host::DeviceInfo{});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].settings.samples, 4U);
    EXPECT_EQ(found[0].hash, "digest");
    EXPECT_DOUBLE_EQ(found[0].seconds_per_pixel, 2.0 / (640 * 360));
}

Json benchmark(const char* name, const std::vector<double>& times)
{
    return {{"name", name}, {"real_time", times[times.size() / 2]}, {"real_times", times}, {"rmse", 0.5}};
}

TEST(ReportComparison, tells_what_changed_and_what_is_in_one_only)
{
    const Json before = {{"benchmarks",
                          {benchmark("same", {1, 2, 3, 4, 5}),
                           benchmark("slow", {1, 2, 3, 4, 5}),
                           benchmark("gone", {1}),
                           {{"name", "failed"}, {"error_occurred", true}}}}};
    const Json after = {
        {"benchmarks",
         {benchmark("slow", {11, 12, 13, 14, 15}), benchmark("same", {1.5, 2.5, 2.6, 3.5, 5}), benchmark("new", {1})}}};
    const ReportComparison found = compare_reports(before, after);
    EXPECT_EQ(found.only_old, std::vector<std::string>{"gone"});
    EXPECT_EQ(found.only_new, std::vector<std::string>{"new"});
    const Table table = comparison_table(found);
    ASSERT_EQ(table.rows.size(), 2U);
    EXPECT_EQ(table.rows[0].front(), "same");
    EXPECT_EQ(table.rows[0].back(), "");
    EXPECT_EQ(table.rows[1].back(), "slower");
    EXPECT_NEAR(found.both[1].p, 2.0 / 252, 1e-12);
    EXPECT_EQ(found.both[1].old_rmse, 0.5);
}

TEST(ReportComparison, refuses_what_is_no_report)
{
    const Json broken = {{"benchmarks", {{{"name", "a"}, {"real_time", 1}}}}};
    EXPECT_THROW(compare_reports(broken, broken), host::Failure);
}

} // namespace
} // namespace clucida::bench
