#include "audio/beat/rival_pulses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "audio/beat/beat_confidence.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// What networks would say of a steady beat of `period` hops with its halves or thirds.
EvidenceLikelihood evidence_of(double hop, double period, int parts) {
    const double phase = hop / period - std::floor(hop / period);
    const auto near = [&](double place) {
        const double apart = phase - place;
        return std::abs(apart - std::round(apart)) * period < 0.75;
    };
    BeatEvidence evidence;
    evidence.beat = near(0.0) ? 0.8F : 0.02F;
    evidence.half = parts == 2 && near(0.5) ? 0.6F : 0.02F;
    evidence.third = parts == 3 && (near(1.0 / 3.0) || near(2.0 / 3.0)) ? 0.6F : 0.02F;
    return likelihood_of(evidence);
}

/// Margins of a beat that is `rate` times as fast as the music's, after 10 s.
PulseMargins margins_after(double rate, double offset, int parts) {
    constexpr double kPeriod = 60.0;
    PulseMargins margins;
    raks::test::RealtimeScope scope;
    for (int hop = 0; hop < 1000; ++hop) {
        const double position = rate * hop / kPeriod + offset;
        margins.add(fit_pulses(position, kPeriod / rate, evidence_of(hop, kPeriod, parts)), 0.998F);
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    return margins;
}

TEST(RivalPulses, the_beat_of_the_music_is_better_than_all_rivals) {
    for (const int parts : {2, 3}) {
        const PulseMargins margins = margins_after(1.0, 0.0, parts);
        for (std::size_t rival = 0; rival < kRivalPulses.size(); ++rival) {
            EXPECT_GT(margins.margin(rival), 3.0F) << rival << " in " << parts;
        }
        EXPECT_GT(margins.over_none(), 6.0F);
        EXPECT_EQ(margins.for_three() > 0.0F, parts == 3);
        EXPECT_GT(judge_beat(ConfidenceModel(), margins, 0.5F, 100.0, 1.0F).confidence, 0.7F)
            << parts;
    }
}

TEST(RivalPulses, a_wrong_beat_has_the_right_one_as_its_rival) {
    struct Wrong {
        double rate;
        double offset;
        double rival_rate;
    };
    for (const Wrong& wrong : {Wrong{2.0, 0.0, 0.5},
                               Wrong{0.5, 0.0, 2.0},
                               Wrong{1.0, 0.5, 1.0},
                               Wrong{1.5, 0.0, 2.0 / 3.0},
                               Wrong{2.0 / 3.0, 0.0, 1.5}}) {
        const PulseMargins margins = margins_after(wrong.rate, wrong.offset, 2);
        const BeatVerdict verdict =
            judge_beat(ConfidenceModel(), margins, 0.5F, 100.0 * wrong.rate, 1.0F);
        EXPECT_LT(verdict.confidence, 0.3F) << wrong.rate << " " << wrong.offset;
        EXPECT_GT(verdict.rival, verdict.confidence) << wrong.rate;
        EXPECT_NEAR(verdict.rival_rate, wrong.rival_rate, 1e-9) << wrong.rate;
    }
}

TEST(RivalPulses, tempi_that_nobody_follows_are_no_rivals) {
    const PulseMargins margins = margins_after(0.5, 0.0, 2);
    // At 130 BPM twice the tempo would be 260, beyond the fastest.
    EXPECT_LT(judge_beat(ConfidenceModel(), margins, 0.5F, 130.0, 1.0F).rival_rate, 2.0);
}

TEST(RivalPulses, without_evidence_on_the_beats_nothing_is_sure) {
    const PulseMargins margins = margins_after(1.0, 0.0, 2);
    EXPECT_EQ(judge_beat(ConfidenceModel(), margins, 0.5F, 100.0, 0.0F).confidence, 0.0F);
    EXPECT_LT(judge_beat(ConfidenceModel(), margins, 0.5F, 100.0, 0.3F).confidence, 0.3F);
    EXPECT_LT(judge_beat(ConfidenceModel(), PulseMargins(), 0.5F, 100.0, 1.0F).confidence, 0.6F);
}

}  // namespace
}  // namespace raks::audio
