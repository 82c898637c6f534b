#include "motion/capture/calibration/view_graph.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace raks::capture {
namespace {

// Cameras a and b see the board together so many times, after all that was seen before.
void share(std::vector<Sighting>& sightings, std::size_t a, std::size_t b, std::size_t times) {
    for (std::size_t i = 0; i < times; ++i) {
        const std::size_t moment = sightings.size();
        sightings.push_back({a, moment, {}});
        sightings.push_back({b, moment, {}});
    }
}

const std::vector<std::string> kNames = {"one", "two", "three", "four"};

TEST(ViewGraph, counts_moments_that_cameras_share) {
    std::vector<Sighting> sightings;
    share(sightings, 0, 1, 5);
    share(sightings, 1, 2, 3);
    sightings.push_back({2, 0, {}});  // a third camera at the first moment
    const SharedViews shared(sightings, 4);
    EXPECT_EQ(shared.between(0, 1), 5U);
    EXPECT_EQ(shared.between(2, 1), 4U);
    EXPECT_EQ(shared.between(0, 2), 1U);
    EXPECT_EQ(shared.between(0, 3), 0U);
    EXPECT_EQ(shared.between(1, 1), 0U);
}

TEST(ViewGraph, joins_cameras_by_what_they_share_most) {
    std::vector<Sighting> sightings;
    share(sightings, 0, 1, 9);
    share(sightings, 0, 2, 20);
    share(sightings, 1, 2, 14);
    share(sightings, 1, 3, 8);
    const auto joins = joins_of(SharedViews(sightings, 4), kNames);
    ASSERT_TRUE(joins) << joins.error().message;
    ASSERT_EQ(joins->size(), 3U);
    const std::vector<std::array<std::size_t, 3>> expected = {{0, 2, 20}, {2, 1, 14}, {1, 3, 8}};
    for (std::size_t i = 0; i < 3; ++i) {
        const Join& join = (*joins)[i];
        EXPECT_EQ((std::array{join.from, join.to, join.shared}), expected[i]);
    }
    const std::vector<std::string> weak = weak_joins(*joins, kNames);
    ASSERT_EQ(weak.size(), 2U);
    EXPECT_EQ(weak[0], "cameras \"three\" and \"two\" share 14 views only; 15 or more are better");
}

TEST(ViewGraph, of_cameras_that_are_not_joined_is_refused_with_what_to_film) {
    std::vector<Sighting> sightings;
    share(sightings, 0, 2, 20);
    share(sightings, 1, 3, 20);
    share(sightings, 1, 2, 2);
    share(sightings, 0, 3, 1);
    const auto joins = joins_of(SharedViews(sightings, 4), kNames);
    ASSERT_FALSE(joins);
    EXPECT_EQ(
        joins.error().message,
        "cameras \"three\" and \"two\" share 2 views, 8 or more are needed to join them; film "
        "the board where both see it");
}

}  // namespace
}  // namespace raks::capture
