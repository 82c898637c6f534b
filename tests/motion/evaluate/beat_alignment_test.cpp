#include "motion/evaluate/beat_alignment.hpp"

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

}  // namespace
}  // namespace raks::motion
