#include "motion/formation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr Formation kGroups[] = {Formation::unison,
                                 Formation::canon,
                                 Formation::free,
                                 Formation::grid,
                                 Formation::ring,
                                 Formation::v};

TEST(Formation, has_its_own_number_of_dancers_and_takes_another) {
    EXPECT_EQ(dancers_in(Formation::solo, 0), 1U);
    EXPECT_EQ(dancers_in(Formation::solo, 12), 1U);
    EXPECT_EQ(dancers_in(Formation::couple, 12), 2U);
    EXPECT_EQ(dancers_in(Formation::unison, 0), 3U);
    for (const Formation formation : kGroups) {
        EXPECT_GE(dancers_in(formation, 0), 3U);
        EXPECT_EQ(dancers_in(formation, 1), 1U);
        EXPECT_EQ(dancers_in(formation, 12), 12U);
        EXPECT_EQ(dancers_in(formation, 99), kMostDancers);
    }
}

TEST(Formation, gives_everybody_a_place_with_room_around_it) {
    for (const Formation formation : kGroups) {
        for (std::size_t dancers = 1; dancers <= kMostDancers; ++dancers) {
            const auto places = places_in(formation, dancers);
            ASSERT_EQ(places.size(), dancers);
            for (std::size_t i = 0; i < dancers; ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    ASSERT_GE(glm::distance(places[i], places[j]), 1.2999)
                        << kFormationNames[static_cast<std::size_t>(formation)] << " of " << dancers
                        << ": " << j << " and " << i;
                }
            }
        }
    }
}

TEST(Formation, fills_the_stage_about_its_middle) {
    constexpr double kStage = 7.5;  // metres to its edge
    for (const Formation formation : kGroups) {
        for (std::size_t dancers = 1; dancers <= kMostDancers; ++dancers) {
            glm::dvec2 sum(0.0);
            for (const glm::dvec2& place : places_in(formation, dancers)) {
                EXPECT_LT(glm::length(place), kStage);
                sum += place;
            }
            EXPECT_LT(glm::length(sum) / static_cast<double>(dancers), 0.75)
                << kFormationNames[static_cast<std::size_t>(formation)] << " of " << dancers;
        }
    }
}

TEST(Formation, of_three_side_by_side_has_the_first_in_the_middle) {
    const std::vector<glm::dvec2> three = {{0.0, 0.0}, {-1.3, 0.0}, {1.3, 0.0}};
    for (const Formation formation : {Formation::unison, Formation::canon, Formation::free}) {
        EXPECT_EQ(places_in(formation, 3), three);
    }
}

// Of those who look at the audience nobody may stand right behind another.
TEST(Formation, rows_stand_before_gaps) {
    for (std::size_t dancers = 4; dancers <= kMostDancers; ++dancers) {
        const auto places = places_in(Formation::grid, dancers);
        for (const glm::dvec2& one : places) {
            for (const glm::dvec2& other : places) {
                if (other.y > one.y && other.y - one.y < 2.0) {
                    EXPECT_GT(std::abs(one.x - other.x), 0.5) << dancers;
                }
            }
        }
    }
}

TEST(Formation, a_wedge_has_the_first_in_front_and_a_ring_everybody_as_far_from_its_middle) {
    const auto wedge = places_in(Formation::v, 7);
    for (std::size_t i = 1; i < wedge.size(); ++i) {
        EXPECT_LT(wedge[i].y, wedge.front().y);
    }
    EXPECT_EQ(wedge.front().x, 0.0);
    for (const glm::dvec2& place : places_in(Formation::ring, 8)) {
        EXPECT_NEAR(glm::length(place), glm::length(places_in(Formation::ring, 8).front()), 1e-9);
    }
}

}  // namespace
}  // namespace raks::motion
