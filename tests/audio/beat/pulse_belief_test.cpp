#include "audio/beat/pulse_belief.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// The number of a pulse of this rate and offset.
std::size_t number_of(double rate, double offset) {
    for (std::size_t number = 0; number <= kRivalPulses.size(); ++number) {
        if (pulse_at(number).rate == rate && pulse_at(number).offset == offset) {
            return number;
        }
    }
    ADD_FAILURE() << rate << " " << offset;
    return 0;
}

/// What a network says that is sure of one pulse.
PulseEvidence sure_of(std::size_t pulse) {
    PulseEvidence evidence{};
    evidence.fill(0.05F / kRivalPulses.size());
    evidence[pulse] = 0.95F;
    return evidence;
}

TEST(PulsePlaces, what_is_half_as_fast_falls_on_every_other_beat) {
    const std::size_t on = number_of(0.5, 0.0);
    const std::size_t between = number_of(0.5, 0.5);
    EXPECT_EQ(place_at(on, 0), on);
    EXPECT_EQ(place_at(on, 1), between);
    EXPECT_EQ(place_at(on, 2), on);
    EXPECT_EQ(place_at(on, -1), between);
    EXPECT_EQ(place_at(number_of(1.0, 0.5), 7), number_of(1.0, 0.5));
    EXPECT_EQ(place_at(0, 5), 0U);
}

// Going on by some beats and back is where it was; no two pulses fall together.
TEST(PulsePlaces, are_a_rotation) {
    for (long beat = -7; beat < 8; ++beat) {
        std::vector<std::size_t> seen;
        for (std::size_t pulse = 0; pulse <= kRivalPulses.size(); ++pulse) {
            const std::size_t there = place_at(pulse, beat);
            EXPECT_EQ(place_at(there, -beat), pulse) << beat;
            seen.push_back(there);
        }
        std::sort(seen.begin(), seen.end());
        EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end()) << beat;
    }
}

TEST(PulseBelief, a_rival_that_all_beats_name_is_better) {
    const std::size_t dotted = number_of(2.0 / 3.0, 1.0 / 3.0);
    PulseBelief belief;
    EXPECT_EQ(belief.right(), 0.5F);
    raks::test::RealtimeScope scope;
    for (long beat = 40; beat < 52; ++beat) {
        belief.observe(beat, sure_of(place_at(dotted, beat)));
    }
    const auto better = belief.better(PulseMargins());
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    ASSERT_TRUE(better);
    EXPECT_EQ(better->rate, 2.0 / 3.0);
    EXPECT_EQ(better->offset, 1.0 / 3.0);
    EXPECT_LT(belief.right(), 0.2F);
}

TEST(PulseBelief, the_followed_pulse_stays_where_it_is_named) {
    PulseBelief belief;
    for (long beat = 0; beat < 12; ++beat) {
        belief.observe(beat, sure_of(0));
    }
    EXPECT_FALSE(belief.better(PulseMargins()));
    EXPECT_GT(belief.right(), 0.9F);
}

TEST(PulseBelief, few_beats_or_beats_that_contradict_each_other_change_nothing) {
    const std::size_t dotted = number_of(2.0 / 3.0, 0.0);
    PulseBelief few;
    for (long beat = 0; beat < 5; ++beat) {
        few.observe(beat, sure_of(place_at(dotted, beat)));
    }
    EXPECT_FALSE(few.better(PulseMargins()));
    // The same number at every beat would be another pulse at each.
    PulseBelief contradicted;
    for (long beat = 0; beat < 24; ++beat) {
        contradicted.observe(beat, sure_of(dotted));
    }
    EXPECT_FALSE(contradicted.better(PulseMargins()));
}

TEST(PulseBelief, evidence_of_single_beats_speaks_against_a_rival) {
    PulseFits fits{};
    fits[0].in_two = 100.0F;  // of the followed pulse
    PulseEvidence evidence = sure_of(number_of(0.5, 0.0));
    const float before = evidence[0];
    weigh_by_margins(PulseMargins(fits), evidence);
    EXPECT_GT(evidence[0], 3.0F * before);
}

}  // namespace
}  // namespace raks::audio
