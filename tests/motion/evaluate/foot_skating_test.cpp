#include "motion/evaluate/foot_skating.hpp"

#include <gtest/gtest.h>

#include "tests/motion/evaluate/small_track.hpp"

namespace raks::motion {
namespace {

using test::resting_track;

/// Both feet slide along x by `left` and `right` metres a frame of 30 a second; hips accelerate
/// upwards by the same amount all the time.
BodyTrack sliding(double left, double right) {
    BodyTrack track = resting_track(200, 30.0);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const auto i = static_cast<double>(f);
        track.joints[f].fill({0.0, 1.0 + 0.001 * i * i, 0.0});
        track.feet[f][0] = {{left * i, 0.06, 0.0}, {left * i, 0.01, 0.0}};
        track.feet[f][1] = {{right * i, 0.06, 0.0}, {right * i, 0.01, 0.0}};
    }
    return track;
}

TEST(PhysicalFootContact, is_the_product_of_both_slides_under_an_even_push) {
    EXPECT_NEAR(physical_foot_contact(sliding(0.02, 0.03)), 1e4 * 0.02 * 0.03, 1e-6);
    EXPECT_EQ(physical_foot_contact(sliding(0.02, 0.0)), 0.0) << "one foot stands";
}

TEST(PhysicalFootContact, forgives_what_gravity_does) {
    BodyTrack falling = sliding(0.02, 0.03);
    for (std::size_t f = 0; f < falling.frames(); ++f) {
        falling.joints[f].fill({0.0, -0.001 * static_cast<double>(f * f), 0.0});
    }
    EXPECT_EQ(physical_foot_contact(falling), 0.0);
    EXPECT_EQ(physical_foot_contact(resting_track(2)), 0.0);
}

TEST(FootSkating, counts_frames_that_slide_over_a_centimetre) {
    // (vx + vz) / 2: 2.2 cm a frame is 1.1 cm in this measure, 1.8 is 0.9. The last frame has no
    // step.
    EXPECT_NEAR(foot_skating_ratio(sliding(0.022, 0.018)), 0.5 * 199.0 / 200.0, 1e-12);
    EXPECT_EQ(foot_skating_ratio(resting_track(0)), 0.0);
}

TEST(FootSkating, looks_at_feet_near_the_floor_alone) {
    BodyTrack track = sliding(0.0, 0.0);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        SourceFoot& foot = track.feet[f][0];
        const bool is_up = f % 4 != 0;  // flies for 3 of 4 frames
        foot.ankle = {0.1 * static_cast<double>(f), is_up ? 0.4 : 0.06, 0.0};
        foot.toe_tip = {0.0, is_up ? 0.3 : 0.01, 0.0};
    }
    EXPECT_NEAR(foot_skating_ratio(track), 0.5, 1e-12) << "the 50 that are down all slide";
}

TEST(FootSkating, is_taken_at_30_frames_a_second_from_any_rate) {
    const BodyTrack slow = sliding(0.022, 0.0);
    BodyTrack fast = resting_track(400, 60.0);
    for (std::size_t f = 0; f < fast.frames(); ++f) {
        fast.joints[f] = slow.joints[f / 2];
        fast.feet[f] = slow.feet[f / 2];
    }
    EXPECT_EQ(foot_skating_ratio(fast), foot_skating_ratio(slow));
    EXPECT_EQ(physical_foot_contact(fast), physical_foot_contact(slow));
}

}  // namespace
}  // namespace raks::motion
