// Cameras that were moved, zoom or wander while they filmed a dancer.
#include "motion/capture/markerless/standing_cameras.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/motion/capture/markerless/keypoint_scene.hpp"

namespace raks::capture {
namespace {

constexpr double kSeconds = 12.0;

/// A change of the pictures of one camera: where a pixel goes at a moment.
using Change = std::function<glm::dvec2(const glm::dvec2& pixel, double time)>;

// Of `still` cameras the background has said that they stood still.
std::vector<std::string> doubts_of(const std::vector<double>& angles,
                                   const Change& change,
                                   const std::vector<std::size_t>& still = {}) {
    const Rig rig = test::ring(angles);
    const auto clocks = test::true_clocks(rig);
    auto films = test::filmed(test::written_dance("hiphop", 0, kSeconds), rig, clocks, {});
    for (KeypointPicture& picture : films[1].pictures) {
        for (Keypoint& point : picture.points) {
            if (point.visibility > 0.0) {
                point.pixel = change(point.pixel, picture.time);
            }
        }
    }
    const auto take = keypoint_take(films, clocks, 30.0);
    std::vector<bool> are_still(angles.size(), false);
    for (const std::size_t camera : still) {
        are_still[camera] = true;
    }
    return take ? standing_doubts(rig, *take, are_still)
                : std::vector<std::string>{take.error().message};
}

// Fifteen pixels are a shake of the head of the network; this is one degree of the camera.
glm::dvec2 bumped_pixel(const glm::dvec2& pixel, double time) {
    return time < 7.0 ? pixel : pixel + glm::dvec2(54.0, 27.0);
}

TEST(StandingCameras, that_stand_are_not_doubted) {
    const auto same = [](const glm::dvec2& pixel, double) { return pixel; };
    EXPECT_TRUE(doubts_of({0.0, 90.0}, same).empty());
    EXPECT_TRUE(doubts_of({0.0, 80.0, 200.0}, same).empty());
}

TEST(StandingCameras, one_of_two_that_was_moved_is_said_with_its_moment) {
    const auto doubts = doubts_of({0.0, 90.0}, bumped_pixel);
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_EQ(doubts[0].rfind("camera1 or camera2 was moved at 7.0 ", 0), 0U) << doubts[0];
}

TEST(StandingCameras, one_of_three_that_was_moved_is_named) {
    const auto doubts = doubts_of({0.0, 80.0, 200.0}, bumped_pixel);
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_EQ(doubts[0].rfind("camera2 was moved at 7.0 ", 0), 0U) << doubts[0];
}

TEST(StandingCameras, one_beside_another_whose_background_stood_is_named) {
    const auto doubts = doubts_of({0.0, 90.0}, bumped_pixel, {0});
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_EQ(doubts[0].rfind("camera2 was moved at 7.0 ", 0), 0U) << doubts[0];
}

TEST(StandingCameras, of_two_whose_backgrounds_stood_the_clocks_alone_are_doubted) {
    const glm::dvec2 middle(359.5, 359.5);
    // As of a dancer who is seen by ever less of the body.
    EXPECT_TRUE(doubts_of({0.0, 90.0},
                          [&](const glm::dvec2& pixel, double time) {
                              return middle + (pixel - middle) * (1.0 + 0.1 * time / kSeconds);
                          },
                          {0, 1})
                    .empty());
    const auto doubts = doubts_of({0.0, 90.0}, bumped_pixel, {0, 1});
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_EQ(doubts[0].rfind("camera1 and camera2 stood still, but ", 0), 0U) << doubts[0];
}

TEST(StandingCameras, one_that_zooms_or_wanders_is_said) {
    const glm::dvec2 middle(359.5, 359.5);
    const auto zoomed = doubts_of({0.0, 90.0}, [&](const glm::dvec2& pixel, double time) {
        return middle + (pixel - middle) * (1.0 + 0.2 * time / kSeconds);
    });
    ASSERT_EQ(zoomed.size(), 1U);
    EXPECT_EQ(zoomed[0].rfind("camera1 or camera2 zooms", 0), 0U) << zoomed[0];
    const auto held = doubts_of({0.0, 90.0}, [](const glm::dvec2& pixel, double time) {
        return pixel + 30.0 * glm::dvec2(std::cos(1.3 * time), std::sin(1.9 * time));
    });
    ASSERT_EQ(held.size(), 1U);
    EXPECT_EQ(held[0].rfind("camera1 or camera2 does not stand still", 0), 0U) << held[0];
}

}  // namespace
}  // namespace raks::capture
