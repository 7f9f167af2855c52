// Where two paths part, and whether another path goes the same way.
#include "bench/divergence.h"
#include "kernels/layout.h"

#include <gtest/gtest.h>

namespace clucida::bench {
namespace {

using oracle::Event;

constexpr std::uint32_t both = EVENT_REFLECTED | EVENT_REFRACTED;
constexpr Event sky(std::uint32_t hop)
{
    return {hop, EVENT_NONE, EVENT_NONE, 0, 0};
}
constexpr Event hit(std::uint32_t hop, std::uint32_t object, std::uint32_t what = 0, std::uint32_t lights = 0)
{
    return {hop, object, 0, what, lights};
}

/// At object 0 a reflection that meets object 1, and a refraction that meets object 2.
const std::vector<Event> fork{hit(0, 0, both), hit(1, 1), hit(1, 2, EVENT_REFLECTED), sky(2)};

TEST(Divergence, EqualPathsHaveNone)
{
    EXPECT_TRUE(divergences(fork, fork).empty());
    EXPECT_TRUE(divergences({}, {}).empty());
}

TEST(Divergence, EachBranchThatDiffersIsOneAndTheOthersAreStillCompared)
{
    std::vector<Event> other = fork;
    other[1].object = 5;
    other[3] = hit(2, 7);
    const std::vector<Divergence> d = divergences(fork, other);
    ASSERT_EQ(d.size(), 2U);
    ASSERT_EQ(d[0].way.size(), 2U);
    EXPECT_EQ(d[0].way[0].branch, std::uint32_t{EVENT_REFLECTED});
    EXPECT_EQ(d[0].way[1].event, fork[1]);
    EXPECT_EQ(d[0].oracle.object, 5U);
    ASSERT_EQ(d[1].way.size(), 3U);
    EXPECT_EQ(d[1].way[0].branch, std::uint32_t{EVENT_REFRACTED});
    EXPECT_EQ(d[1].oracle.object, 7U);
}

TEST(Divergence, WhatFollowsASurfaceThatDiffersIsPassedBy)
{
    const std::vector<Event> other{hit(0, 0, both), hit(1, 5, both), sky(2), sky(2), hit(1, 2, EVENT_REFLECTED),
                                   sky(2)};
    const std::vector<Divergence> d = divergences(fork, other);
    ASSERT_EQ(d.size(), 1U);
    EXPECT_EQ(d[0].oracle.object, 5U);
}

TEST(Divergence, ABranchThatOnePathDoesNotFollowIsOneAtItsSurfaceOnly)
{
    const std::vector<Event> other{hit(0, 0, EVENT_REFRACTED), hit(1, 2, EVENT_REFLECTED), sky(2)};
    const std::vector<Divergence> d = divergences(fork, other);
    ASSERT_EQ(d.size(), 1U);
    EXPECT_EQ(d[0].way.size(), 1U);
}

TEST(Divergence, LightsThatDifferAreOne)
{
    std::vector<Event> other = fork;
    other[1].lights = 2;
    EXPECT_EQ(divergences(fork, other).size(), 1U);
}

TEST(Divergence, APathHasAWayIfItMeetsTheSameSurfacesAndTheSameEventAtItsEnd)
{
    std::vector<Event> other = fork;
    other[3] = hit(2, 7);
    const std::vector<Divergence> d = divergences(fork, other);
    ASSERT_EQ(d.size(), 1U);
    EXPECT_TRUE(has_way(fork, d[0]));
    EXPECT_FALSE(has_way(other, d[0]));

    std::vector<Event> third = fork; // differs beside the way: no matter
    third[1].object = 9;
    EXPECT_TRUE(has_way(third, d[0]));
    third[2].object = 9; // and on it
    EXPECT_FALSE(has_way(third, d[0]));
    EXPECT_FALSE(has_way(std::span(fork).first(1), d[0]));
    EXPECT_FALSE(has_way({}, d[0]));
}

} // namespace
} // namespace clucida::bench
