// Whether times differ: the rank test against values that statistics books and other programs give.
#include "bench/rank_test.h"

#include <gtest/gtest.h>

namespace clucida::bench {
namespace {

using Sample = std::vector<double>;

TEST(RankTest, is_exact_for_samples_that_do_not_overlap)
{
    EXPECT_NEAR(rank_test({1, 2, 3}, {4, 5, 6}), 2.0 / 20, 1e-12);               // of 6 over 3 orders
    EXPECT_NEAR(rank_test({1, 2, 3, 4, 5}, {6, 7, 8, 9, 10}), 2.0 / 252, 1e-12); // of 10 over 5
    EXPECT_NEAR(rank_test({7, 8, 9}, {1, 2}), 2.0 / 10, 1e-12);
}

TEST(RankTest, is_exact_for_samples_that_overlap)
{
    // U = 2 of 4 and 4 values: orders with U of 0, 1 and 2 are 1 + 1 + 2 of 70.
    EXPECT_NEAR(rank_test({1, 2, 3, 6}, {4, 5, 7, 8}), 2 * 4.0 / 70, 1e-12);
    // Two medians as near as can be.
    EXPECT_NEAR(rank_test({1, 4}, {2, 3}), 1, 1e-12);
}

TEST(RankTest, does_not_care_which_sample_comes_first)
{
    const Sample a{1.5, 2.5, 3.5, 9, 10, 12}, b{1, 2, 3, 4, 5};
    EXPECT_DOUBLE_EQ(rank_test(a, b), rank_test(b, a));
}

TEST(RankTest, corrects_for_ties)
{
    // U = 2.5 of 16, ties of 2, 2 and 3: sigma^2 = 4 * 4 / 12 * (9 - (6 + 6 + 24) / 56); z = (5.5 - 0.5) / sigma.
    EXPECT_NEAR(rank_test({1, 1, 2, 3}, {2, 3, 3, 4}), 0.1341691801, 1e-9);
    EXPECT_EQ(rank_test({5, 5, 5}, {5, 5, 5, 5}), 1);
}

TEST(RankTest, comes_near_the_exact_value_where_samples_are_large)
{
    Sample a, b;
    for (int i = 0; i < 60; ++i) {
        a.push_back(i);
        b.push_back(i + 0.5);
    }
    EXPECT_GT(rank_test(a, b), 0.8);
    for (double& x : b) x += 30;
    EXPECT_LT(rank_test(a, b), 1e-6);
}

TEST(RankTest, tells_nothing_from_nothing)
{
    EXPECT_EQ(rank_test({}, {1, 2, 3}), 1);
}

} // namespace
} // namespace clucida::bench
