// How markers are followed where nobody says it.
#include "apps/raks_capture/tracking_step.hpp"

#include <gtest/gtest.h>

namespace raks::apps {
namespace {

TEST(TrackingStep, follows_a_body_where_few_cameras_see_markers_of_one_colour) {
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

}  // namespace
}  // namespace raks::apps
