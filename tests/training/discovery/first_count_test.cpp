#include "training/discovery/first_count.hpp"

#include <gtest/gtest.h>

#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::motion::first_count_test {
namespace {

TEST(FirstCount, beats_are_as_many_as_a_dance_of_that_tempo_has) {
    struct Row {
        double seconds;
        double landings;
        int bar;
        int beats;
    };
    for (const Row& row : {Row{2.93, 6, 4, 8},     // salsa at 164 BPM
                           Row{2.55, 6, 4, 8},     // salsa at 188 BPM
                           Row{1.8, 4, 4, 4},      // steps at 133 BPM
                           Row{3.4, 4, 4, 8},      // 141 BPM, a step on every other beat
                           Row{2.0, 3, 3, 3},      // a waltz of 90 BPM
                           Row{8.0, 8, 4, 16}}) {  // a phrase at 120 BPM
        EXPECT_EQ(beats_of_repeat(row.seconds, row.landings, row.bar), row.beats) << row.seconds;
    }
}

TEST(FirstCount, is_the_leading_foots_step_after_the_rest) {
    for (const bool is_mirrored : {false, true}) {
        test::SteppingDance dance;
        dance.is_mirrored = is_mirrored;
        const MotionSignals signals = motion_signals(test::stepping_clip(dance));
        // Repeats that begin on count 3.
        const double beat = dance.beat * kSignalRate;
        std::vector<RepeatSpan> repeats;
        for (int r = 0; r < 5; ++r) {
            repeats.push_back({dance.count_1(r) * kSignalRate + 2.0 * beat, 8.0 * beat});
        }
        const auto phase = phase_of_count_1(
            signals.landings, repeats, is_mirrored ? DanceRole::follow : DanceRole::lead, 8, {});
        ASSERT_TRUE(phase);
        EXPECT_NEAR(*phase, 6.0 / 8.0, 0.4 / 8.0);
        EXPECT_NEAR(landings_of_repeat(signals.landings, repeats), 6.0, 1.0);
    }
}

TEST(FirstCount, is_not_known_where_no_foot_lands) {
    const std::vector<RepeatSpan> repeats = {{0.0, 60.0}, {60.0, 60.0}};
    EXPECT_FALSE(phase_of_count_1({}, repeats, DanceRole::lead, 4, {}));
}

}  // namespace
}  // namespace raks::motion::first_count_test
