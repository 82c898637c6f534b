#include "motion/dance/key_moment.hpp"

#include <gtest/gtest.h>

#include "motion/dance/dance_content.hpp"
#include "motion/dance/dancer_part.hpp"
#include "tests/motion/dance/stage.hpp"

namespace raks::motion::key_moment_test {
namespace {

const DanceContent& salsa() {
    static const DanceContent content = [] {
        auto made = make_content(test::salsa_figures(), mannequin_skeleton(), nullptr);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }();
    return content;
}

DanceSequence begun() {
    DanceSequence sequence;
    sequence.start(salsa(), salsa().stage, DancerPart{}, false);
    return sequence;
}

TEST(KeyMoment, is_one_in_which_both_feet_stand_where_there_is_one) {
    const DanceSequence sequence = begun();
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
    const DanceSequence sequence = begun();
    for (double from = 0.0; from < 5.0; from += 0.3) {
        const Beats until = stands_until(sequence, Beats(from), Beats(from + 2.0));
        for (double at = from; at <= until.count(); at += 0.2) {
            const Pose pose = sequence.at(Beats(at));
            EXPECT_TRUE(at == from || (pose.foot_contact[0] && pose.foot_contact[1])) << at;
        }
    }
}

}  // namespace
}  // namespace raks::motion::key_moment_test
