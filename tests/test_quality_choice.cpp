// Settings for an error: which are chosen, and how what was measured is kept.
#include "host/calibration.h"
#include "host/errors.h"
#include "host/quality_choice.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

namespace clucida::host {
namespace {

using Records = std::vector<CalibrationRecord>;

CalibrationRecord record(const std::string& hash, unsigned samples, double seconds, double rmse)
{
    CalibrationRecord out;
    out.scene = out.hash = hash;
    out.picture = {160, 90};
    out.settings.samples = samples;
    out.seconds_per_pixel = seconds;
    out.rmse = rmse;
    return out;
}

QualityRequest request(double max_error, const std::string& hash)
{
    QualityRequest out;
    out.max_error = max_error;
    out.hash = hash;
    out.picture = {160, 90};
    return out;
}

/// Three scenes with 1 and 4 samples, of which "c" is the hardest.
Records three_scenes()
{
    return {record("a", 1, 1, 0.02), record("b", 1, 1, 0.03), record("c", 1, 1, 0.08),
            record("a", 4, 4, 0.01), record("b", 4, 4, 0.01), record("c", 4, 4, 0.04)};
}

TEST(QualityChoice, is_the_fastest_on_this_scene_that_suffices)
{
    const auto choice = choose_quality(three_scenes(), request(0.025, "a"));
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->settings.samples, 1U);
    EXPECT_TRUE(choice->suffices);
    EXPECT_EQ(choice->expected, 0.02);
    EXPECT_EQ(describe_source(*choice), "calibrated on this scene");
    EXPECT_EQ(choose_quality(three_scenes(), request(0.015, "a"))->settings.samples, 4U);
}

TEST(QualityChoice, is_the_most_accurate_where_none_suffices)
{
    const auto choice = choose_quality(three_scenes(), request(1e-3, "b"));
    ASSERT_TRUE(choice);
    EXPECT_FALSE(choice->suffices);
    EXPECT_EQ(choice->settings.samples, 4U);
    EXPECT_EQ(choice->expected, 0.01);
}

TEST(QualityChoice, expects_for_another_scene_the_worst_of_those_known)
{
    const auto choice = choose_quality(three_scenes(), request(0.05, "d"));
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->settings.samples, 4U);
    EXPECT_EQ(choice->expected, 0.04);
    EXPECT_EQ(choice->scenes, 3U);
    EXPECT_EQ(describe_source(*choice), "the worst of 3 calibrated scenes");
}

TEST(QualityChoice, is_not_made_from_too_few_other_scenes)
{
    Records records = three_scenes();
    records.pop_back(); // 4 samples are known of two scenes only
    EXPECT_EQ(choose_quality(records, request(0.05, "d"))->settings.samples, 1U);
    records.resize(2);
    EXPECT_FALSE(choose_quality(records, request(0.05, "d")));
}

TEST(QualityChoice, has_for_another_scene_its_own_hops_and_cutoff)
{
    Records records = three_scenes();
    for (const char* scene : {"a", "b", "c"}) {
        records.push_back(record(scene, 1, 0.1, 1e-6));
        records.back().settings.max_hops = 4;
    }
    EXPECT_FALSE(choose_quality(records, request(0.1, "d"))->settings.max_hops);
    EXPECT_EQ(choose_quality(records, request(0.1, "a"))->settings.max_hops, 4U);
}

TEST(QualityChoice, leaves_alone_what_is_given)
{
    Records records = three_scenes();
    records.push_back(record("a", 1, 9, 1e-7));
    records.back().settings.precision = Precision::twofold;
    QualityRequest asked = request(0.1, "a");
    asked.samples = 4;
    EXPECT_EQ(choose_quality(records, asked)->settings.samples, 4U);
    asked.samples.reset();
    asked.precision = Precision::twofold;
    EXPECT_EQ(choose_quality(records, asked)->settings.precision, Precision::twofold);
    asked.precision.reset();
    asked.max_hops = 7; // of which nothing is known
    EXPECT_FALSE(choose_quality(records, asked));
    asked.max_hops.reset();
    asked.kernel = "pixels";
    EXPECT_FALSE(choose_quality(records, asked));
}

TEST(QualityChoice, goes_by_pictures_of_the_same_size_where_there_are_such)
{
    Records records{record("a", 1, 1, 0.1), record("a", 1, 1, 0.02)};
    records[0].picture = {40, 20};
    EXPECT_EQ(choose_quality(records, request(0.05, "a"))->expected, 0.02);
    records[1].picture = {80, 45};
    EXPECT_EQ(choose_quality(records, request(0.05, "a"))->expected, 0.1);
}

/// In a folder of its own, which is the user's cache meanwhile.
class Storage : public testing::Test {
protected:
    Storage()
    {
        std::string name = (std::filesystem::temp_directory_path() / "clucida-test-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        ::setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
        device_.name = "a device";
    }
    ~Storage() override
    {
        ::unsetenv("XDG_CACHE_HOME");
        std::filesystem::remove_all(folder_);
    }

    std::filesystem::path folder_;
    DeviceInfo device_;
};

TEST_F(Storage, gives_back_what_was_kept)
{
    EXPECT_TRUE(load_calibration(device_).empty());
    CalibrationRecord r = record("a", 4, 1.5e-7, 0.01);
    r.kernel = "packets";
    r.settings = {Precision::twofold, 4, 7U, 0.125};
    r.p999 = 0.2;
    r.max_error = 0.4;
    store_calibration(device_, {r});
    const Records found = load_calibration(device_);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].settings, r.settings);
    EXPECT_EQ(found[0].hash, "a");
    EXPECT_EQ(found[0].kernel, "packets");
    EXPECT_EQ(found[0].picture, r.picture);
    EXPECT_EQ(found[0].seconds_per_pixel, r.seconds_per_pixel);
    EXPECT_EQ(found[0].rmse, r.rmse);
    EXPECT_EQ(found[0].p999, r.p999);
    EXPECT_EQ(found[0].max_error, r.max_error);
}

TEST_F(Storage, replaces_the_same_and_adds_the_rest)
{
    store_calibration(device_, {record("a", 1, 1, 0.5), record("a", 4, 1, 0.5)});
    store_calibration(device_, {record("a", 1, 1, 0.25), record("b", 1, 1, 0.5)});
    const Records found = load_calibration(device_);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[1].rmse, 0.25);
}

TEST_F(Storage, is_of_one_device_and_driver)
{
    store_calibration(device_, {record("a", 1, 1, 0.5)});
    DeviceInfo other = device_;
    other.driver = "2";
    EXPECT_TRUE(load_calibration(other).empty());
    EXPECT_NE(calibration_file(other), calibration_file(device_));
}

TEST_F(Storage, tells_of_a_broken_file_and_goes_on)
{
    store_calibration(device_, {record("a", 1, 1, 0.5)});
    for (const char* text : {"{", "[]", "{\"format\": \"clucida calibration 1\", \"records\": [{}]}"}) {
        std::ofstream(calibration_file(device_)) << text;
        std::string problem;
        EXPECT_TRUE(load_calibration(device_, &problem).empty());
        EXPECT_NE(problem.find("broken"), std::string::npos);
    }
    store_calibration(device_, {record("a", 1, 1, 0.5)});
    EXPECT_EQ(load_calibration(device_).size(), 1U);
}

} // namespace
} // namespace clucida::host
