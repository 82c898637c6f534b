#include "motion/evaluate/published_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/motion/evaluate/small_track.hpp"

namespace raks::motion {
namespace {

using test::resting_track;

constexpr double kFrameRate = 60.0;

/// Every joint swings to and fro: it rests (a beat of the motion) every `period` frames, from frame
/// `first` on.
BodyTrack swinging(std::size_t frames, double period, double first) {
    BodyTrack track = resting_track(frames);
    for (std::size_t f = 0; f < frames; ++f) {
        const double turn = M_PI * (static_cast<double>(f) - first) / period;
        track.joints[f].fill({0.2 * std::cos(turn), 1.0, 0.0});
    }
    return track;
}

std::vector<double> beats(double first, double period, std::size_t count) {
    std::vector<double> times;
    for (std::size_t i = 0; i < count; ++i) {
        times.push_back((first + period * static_cast<double>(i)) / kFrameRate);
    }
    return times;
}

TEST(BeatAlignment, is_1_where_motion_rests_on_the_beat_and_falls_by_the_kernel_beside_it) {
    // The slowest of the steps between frames is the one into frame 15.5 of both halves: minima
    // fall between two frames where the swing rests on half a frame.
    const BodyTrack track = swinging(600, 30.0, 15.5);
    EXPECT_NEAR(motion_beat_alignment(track, beats(16.0, 30.0, 20)), 1.0, 1e-9);
    EXPECT_NEAR(music_beat_alignment(track, beats(15.0, 30.0, 20)), 1.0, 1e-9);
    const double three_frames_off = std::exp(-0.5);
    EXPECT_NEAR(motion_beat_alignment(track, beats(19.0, 30.0, 20)), three_frames_off, 1e-9);
    EXPECT_NEAR(music_beat_alignment(track, beats(18.0, 30.0, 20)), three_frames_off, 1e-9);
}

TEST(BeatAlignment, means_over_motion_in_one_form_and_over_music_in_the_other) {
    // Music twice as dense: each rest has its beat, but every second beat is 15 frames from one.
    const BodyTrack track = swinging(600, 30.0, 15.5);
    EXPECT_NEAR(motion_beat_alignment(track, beats(16.0, 15.0, 39)), 1.0, 1e-9);
    EXPECT_NEAR(music_beat_alignment(track, beats(15.0, 15.0, 39)), 20.0 / 39.0, 1e-5);
}

TEST(BeatAlignment, is_0_without_beats_and_without_motion) {
    EXPECT_EQ(motion_beat_alignment(swinging(600, 30.0, 15.5), {}), 0.0);
    EXPECT_EQ(music_beat_alignment(swinging(600, 30.0, 15.5), {}), 0.0);
    EXPECT_EQ(motion_beat_alignment(resting_track(600), beats(0.0, 30.0, 20)), 0.0);
    EXPECT_EQ(music_beat_alignment(resting_track(600), beats(0.0, 30.0, 20)), 0.0);
    EXPECT_EQ(motion_beat_alignment(resting_track(0), beats(0.0, 30.0, 20)), 0.0);
    EXPECT_EQ(music_beat_alignment(resting_track(1), beats(0.0, 30.0, 20)), 0.0);
}

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
