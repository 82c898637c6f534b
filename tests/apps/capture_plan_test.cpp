// What follows from a capture where nobody says it.
#include "apps/raks_capture/capture_plan.hpp"

#include <gtest/gtest.h>

namespace raks::apps {
namespace {

TEST(CapturePlan, has_a_body_followed_where_few_cameras_see_markers_of_one_colour) {
    const capture::MarkerSet five = capture::default_markers();
    const capture::MarkerSet unique = capture::default_markers(capture::MarkerColours::unique);
    EXPECT_TRUE(is_body_followed({}, five, 2));
    EXPECT_TRUE(is_body_followed({}, five, 4));
    EXPECT_FALSE(is_body_followed({}, five, 5));
    EXPECT_FALSE(is_body_followed({}, unique, 3));
    // What is said counts first.
    EXPECT_FALSE(is_body_followed(TrackingMethod::positions, five, 3));
    EXPECT_TRUE(is_body_followed(TrackingMethod::angles, unique, 8));
    // A body is found by its trunk.
    capture::MarkerSet limbs = five;
    std::erase_if(limbs.markers, [](const capture::Marker& marker) {
        return marker.bone == motion::Bone::hips || marker.bone == motion::Bone::chest ||
               marker.bone == motion::Bone::upper_chest || marker.bone == motion::Bone::spine;
    });
    EXPECT_FALSE(is_body_followed({}, limbs, 3));
}

TEST(CapturePlan, tells_how_many_cameras_colours_need) {
    const capture::MarkerSet five = capture::default_markers();
    EXPECT_EQ(too_few_for_colours(five, 2),
              "2 cameras are too few to follow 20 markers of 5 colours: 3 or more are needed");
    EXPECT_EQ(too_few_for_colours(five, 3), "");
    EXPECT_EQ(too_few_for_colours(capture::default_markers(capture::MarkerColours::unique), 2), "");
}

TEST(CapturePlan, needs_two_cameras) {
    CapturePlan plan;
    plan.folder = "take";
    plan.cameras = {{"cam1", "cam1.mp4", {}, 0.0}};
    const auto alone = check_cameras(plan);
    ASSERT_FALSE(alone);
    EXPECT_EQ(alone.error().message.find("take/capture.toml: one camera is too few"), 0U)
        << alone.error().message;
    plan.cameras.push_back({"cam2", "cam2.mp4", {}, 0.0});
    EXPECT_TRUE(check_cameras(plan));
}

}  // namespace
}  // namespace raks::apps
