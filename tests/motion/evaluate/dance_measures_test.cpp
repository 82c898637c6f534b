#include "motion/evaluate/dance_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

}  // namespace
}  // namespace raks::motion
