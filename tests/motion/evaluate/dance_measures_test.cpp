#include "motion/evaluate/dance_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/evaluate/dance_metrics.hpp"
#include "tests/motion/evaluate/small_track.hpp"

namespace raks::motion {
namespace {

/// Hips to and fro over `size` metres once a second, 10 s.
BodyTrack rocking(double size) {
    BodyTrack track = test::resting_track(600);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const double place = 0.5 * size * std::sin(2.0 * M_PI * static_cast<double>(f) / 60.0);
        track.joints[f].fill({0.0, 1.0, place});
    }
    return track;
}

DanceSubject two_repeats() {
    DanceSubject subject;
    subject.repeats = {{"rock", {1.0, 2.0, 3.0}}, {"rock", {3.0, 4.0, 5.0}}};
    return subject;
}

TEST(DanceMeasures, gather_the_repeats_of_each_figure) {
    DanceSubject subject = two_repeats();
    subject.repeats.push_back({"other rock", {5.0, 7.0}});
    subject.repeats.push_back({"rock", {8.0, 11.0}});  // beyond the track
    const DanceMeasures measures = measure_dance(rocking(0.5), subject);
    ASSERT_EQ(measures.figures.size(), 2U);
    EXPECT_EQ(measures.figures[0].figure, "rock");
    ASSERT_EQ(measures.figures[0].amplitudes.size(), 2U);
    EXPECT_NEAR(measures.figures[0].amplitudes[0].hips_travel, 0.5, 1e-9);
    EXPECT_EQ(measures.figures[0].shapes.size(), 2U);
    EXPECT_EQ(measures.figures[1].amplitudes.size(), 1U);
}

TEST(DanceMeasures, leave_out_repeats_that_touch_a_fault) {
    DanceSubject subject = two_repeats();
    subject.frames.counted.assign(600, true);
    subject.frames.counted[100] = false;
    const DanceMeasures measures = measure_dance(rocking(0.5), subject);
    ASSERT_EQ(measures.figures.size(), 1U);
    EXPECT_EQ(measures.figures[0].amplitudes.size(), 1U);
}

TEST(DanceMeasures, pooled_join_the_contacts_of_all) {
    DanceMeasures high;
    high.contacts.lowest_toe = 0.02;
    high.contacts.standing = 1;
    DanceMeasures higher;
    higher.contacts.lowest_toe = 0.05;
    higher.contacts.standing = 2;
    const DanceMeasures all = pooled(std::vector{high, higher});
    EXPECT_EQ(all.contacts.lowest_toe, 0.02) << "0 is lower than both";
    EXPECT_EQ(all.contacts.standing, 3U);
}

TEST(DanceMeasures, of_a_part_are_timed_from_where_it_begins) {
    // The same swing, idle before: what comes before the first counted frame must not matter.
    BodyTrack late = test::resting_track(700);
    const BodyTrack track = rocking(0.5);
    DanceSubject subject;
    subject.frames.counted.assign(700, false);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        late.joints[f + 100] = track.joints[f];
        subject.frames.counted[f + 100] = true;
    }
    DanceSubject whole;
    for (int beat = 0; beat < 20; ++beat) {
        whole.beat_times.push_back(0.25 + 0.5 * beat);
        subject.beat_times.push_back(0.25 + 0.5 * beat + 100.0 / 60.0);
    }
    const DanceMeasures expected = measure_dance(track, whole);
    const DanceMeasures found = measure_dance(late, subject);
    EXPECT_GT(expected.bas_music, 0.8);
    EXPECT_NEAR(found.bas_music, expected.bas_music, 1e-9);
    EXPECT_NEAR(found.bas_motion, expected.bas_motion, 1e-9);
}

TEST(DanceMeasures, of_several_dances_are_of_all_their_samples) {
    const std::vector<DanceMeasures> dances = {measure_dance(rocking(0.5), two_repeats()),
                                               measure_dance(rocking(1.0), two_repeats())};
    const DanceMeasures all = pooled(dances);
    const double squares =
        dances[0].jerk.rms * dances[0].jerk.rms + dances[1].jerk.rms * dances[1].jerk.rms;
    EXPECT_NEAR(all.jerk.rms, std::sqrt(squares / 2.0), 1e-9);
    EXPECT_EQ(all.jerk.highest, dances[1].jerk.highest);
    ASSERT_EQ(all.figures.size(), 1U);
    EXPECT_EQ(all.figures[0].amplitudes.size(), 4U);
    EXPECT_NEAR(all.contacts.share, 1.0, 1e-12) << "feet that never move";
}

/// All joints on a sine of `hz`, 5 cm.
BodyTrack swaying(double hz) {
    BodyTrack track = test::resting_track(600);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const double angle = 2.0 * M_PI * hz * static_cast<double>(f) / track.frames_per_second;
        track.joints[f].fill({0.05 * std::sin(angle), 1.0, 0.0});
        track.feet[f][0].toe_tip = {0.05 * std::sin(angle), 0.0, 0.0};
    }
    return track;
}

TEST(PlayedAtPace, is_the_same_dance_in_another_time) {
    const BodyTrack fast = played_at_pace(swaying(1.0), 1.5);
    const BodyTrack expected = swaying(1.5);
    ASSERT_EQ(fast.frames(), 400U);
    for (std::size_t f = 2; f + 2 < fast.frames(); ++f) {
        EXPECT_NEAR(fast.joints[f][3].x, expected.joints[f][3].x, 1e-4) << f;
        EXPECT_NEAR(fast.feet[f][0].toe_tip.x, expected.feet[f][0].toe_tip.x, 1e-4) << f;
    }
    MetricFrames frames;
    frames.counted.assign(600, true);
    frames.counted[300] = false;
    const MetricFrames played = frames_at_pace(frames, 600, 1.5);
    ASSERT_EQ(played.counted.size(), fast.frames());
    EXPECT_FALSE(played.is_counted(200));
    EXPECT_TRUE(played.is_counted(198));
    EXPECT_EQ(played.pace_at(7), 1.5);
}

TEST(JerkByPace, falls_for_quick_motion_by_the_filter_alone) {
    // 1-4-6-4-1 passes cos^4(pi f / rate), a third difference sinc^3(f / rate).
    const auto gain = [](double hz) {
        const double x = M_PI * hz / 60.0;
        return std::pow(std::cos(x), 4.0) * std::pow(std::sin(x) / x, 3.0);
    };
    MetricFrames frames;  // not the ends, where the sine is cut
    for (std::size_t f = 0; f < 600; ++f) {
        frames.counted.push_back(f >= 20 && f < 580);
    }
    const JerkByPace slow = jerk_by_pace(swaying(1.0), frames);
    const JerkByPace quick = jerk_by_pace(swaying(6.0), frames);
    for (std::size_t p = 0; p < kJudgedPaces.size(); ++p) {
        const double pace = kJudgedPaces[p];
        // 2 %: the interpolation between frames.
        EXPECT_NEAR(slow[p].rms() / slow[3].rms(), gain(pace) / gain(1.0), 0.02) << pace;
        EXPECT_NEAR(quick[p].rms() / quick[3].rms(), gain(6.0 * pace) / gain(6.0), 0.02) << pace;
    }
}

}  // namespace
}  // namespace raks::motion
