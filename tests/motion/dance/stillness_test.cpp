#include "motion/dance/dynamics/stillness.hpp"

#include <gtest/gtest.h>

#include "motion/dance/dance_content.hpp"
#include "motion/dance/dancer_part.hpp"
#include "tests/motion/dance/stage.hpp"

namespace raks::motion::stillness_test {
namespace {

const DanceContent& salsa() {
    static const DanceContent content = [] {
        auto made = make_content(test::salsa_figures(), mannequin_skeleton(), nullptr);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }();
    return content;
}

FigureSequence begun() {
    FigureSequence sequence;
    sequence.start(salsa(), salsa().stage, DancerPart{}, false);
    return sequence;
}

StreamTime at(double seconds) { return stream_time_from_seconds(seconds); }

TEST(Stillness, slows_down_evenly_and_stands_at_its_moment) {
    Stillness still;
    still.begin(at(10.0), Beats(4.0), 3.0, Beats(4.3));
    EXPECT_NEAR(still.phase(at(10.0)).count(), 4.0, 1e-9);
    EXPECT_NEAR(still.phase(at(10.001)).count(), 4.003, 1e-4) << "at full speed first";
    EXPECT_FALSE(still.is_at_rest(at(10.19)));
    EXPECT_TRUE(still.is_at_rest(at(10.201))) << "twice the time that 0.3 beats take";
    EXPECT_NEAR(still.phase(at(10.201)).count(), 4.3, 1e-9);
    EXPECT_NEAR(still.phase(at(20.0)).count(), 4.3, 1e-9);
    double before = 4.0;
    for (int ms = 1; ms < 300; ++ms) {
        const double phase = still.phase(at(10.0 + 0.001 * ms)).count();
        ASSERT_GE(phase, before);
        ASSERT_LE(phase - before, 0.0031);
        before = phase;
    }
}

TEST(Stillness, keeps_its_posture_until_it_begins_anew) {
    Stillness still;
    still.begin(at(1.0), Beats(1.0), 2.0, Beats(1.2));
    EXPECT_FALSE(still.posture());
    still.keep(begun().at(Beats(1.2)));
    EXPECT_TRUE(still.posture());
    still.begin(at(5.0), Beats(3.0), 2.0, Beats(3.2));
    EXPECT_FALSE(still.posture());
}

TEST(KeyMoment, is_one_in_which_both_feet_stand_where_there_is_one) {
    const FigureSequence sequence = begun();
    for (double from = 0.5; from < 6.0; from += 0.25) {
        const Beats to(from + 1.0);
        const Beats key = key_moment(sequence, Beats(from), to);
        EXPECT_GE(key.count(), from);
        EXPECT_LE(key.count(), to.count());
        bool any = false;
        for (int i = 0; i <= 8; ++i) {
            const Pose pose = sequence.at(Beats(from + 0.125 * i));
            any = any || (pose.foot_contact[0] && pose.foot_contact[1]);
        }
        const Pose pose = sequence.at(key);
        EXPECT_EQ(pose.foot_contact[0] && pose.foot_contact[1], any) << from;
    }
}

TEST(StandsUntil, ends_where_a_foot_leaves_the_floor) {
    const FigureSequence sequence = begun();
    for (double from = 0.0; from < 5.0; from += 0.3) {
        const Beats until = stands_until(sequence, Beats(from), Beats(from + 2.0));
        for (double at = from; at <= until.count(); at += 0.2) {
            const Pose pose = sequence.at(Beats(at));
            EXPECT_TRUE(at == from || (pose.foot_contact[0] && pose.foot_contact[1])) << at;
        }
    }
}

}  // namespace
}  // namespace raks::motion::stillness_test
