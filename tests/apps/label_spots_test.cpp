#include "apps/raks_capture/label_spots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 100;

/// A grey picture with discs.
class DiscPicture {
 public:
    DiscPicture() : rgb_(std::size_t{3} * kWidth * kHeight, 120) {}

    void draw(const glm::dvec2& middle, int red, int green, int blue) {
        constexpr double kRadius = 5.0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                if (glm::distance(middle, glm::dvec2(x, y)) <= kRadius) {
                    const auto at = static_cast<std::size_t>(3 * (y * kWidth + x));
                    rgb_[at] = static_cast<std::uint8_t>(red);
                    rgb_[at + 1] = static_cast<std::uint8_t>(green);
                    rgb_[at + 2] = static_cast<std::uint8_t>(blue);
                }
            }
        }
    }
    [[nodiscard]] capture::PictureView view() const { return {kWidth, kHeight, rgb_}; }

 private:
    std::vector<std::uint8_t> rgb_;
};

TEST(LabelSpots, one_label_of_a_colour_finds_the_others) {
    DiscPicture picture;
    picture.draw({30.0, 40.0}, 40, 180, 60);
    picture.draw({90.0, 60.0}, 42, 178, 62);
    picture.draw({60.0, 20.0}, 60, 70, 190);
    LabelSpots spots(2);
    EXPECT_TRUE(spots.find(picture.view(), {}).empty()) << "nothing is learnt yet";
    const auto found = spots.find(picture.view(), {{1, {30.0, 40.0}}});
    ASSERT_EQ(found.size(), 2U);
    for (const capture::Detection& spot : found) {
        EXPECT_EQ(spot.colour, 1U);
        EXPECT_LT(std::min(glm::distance(spot.pixel, {30.0, 40.0}),
                           glm::distance(spot.pixel, {90.0, 60.0})),
                  0.5);
    }
}

TEST(LabelSpots, what_one_picture_taught_is_found_in_the_next) {
    DiscPicture first;
    first.draw({30.0, 40.0}, 40, 180, 60);
    DiscPicture second;
    second.draw({110.0, 70.0}, 36, 165, 54);
    LabelSpots spots(1);
    EXPECT_EQ(spots.find(first.view(), {{0, {30.0, 40.0}}}).size(), 1U);
    const auto found = spots.find(second.view(), {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT(glm::distance(found.front().pixel, {110.0, 70.0}), 0.5);
}

TEST(LabelSpots, a_label_beside_its_marker_teaches_nothing) {
    DiscPicture picture;
    picture.draw({30.0, 40.0}, 40, 180, 60);
    LabelSpots spots(1);
    EXPECT_TRUE(spots.find(picture.view(), {{0, {120.0, 80.0}}}).empty());
    EXPECT_EQ(spots.find(picture.view(), {{0, {120.0, 80.0}}, {0, {30.0, 40.0}}}).size(), 1U);
}

}  // namespace
}  // namespace raks::apps
