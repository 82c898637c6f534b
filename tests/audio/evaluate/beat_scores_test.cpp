#include "audio/evaluate/beat_scores.hpp"

#include <gtest/gtest.h>

#include <set>

namespace raks::audio {
namespace {

using M = BeatMeasure;

/// Beats of 4/4 at 120 BPM from 0.5 s on; the second is a downbeat.
BeatList bars(int count) {
    BeatList list;
    for (int i = 0; i < count; ++i) {
        list.times.push_back(0.5 + 0.5 * i);
        list.bar_positions.push_back((i + 3) % 4 + 1);
    }
    return list;
}

TEST(ScoreBeats, gives_a_perfect_tracker_full_marks) {
    const BeatList reference = bars(60);
    const BeatScores scores = score_beats(reference, {reference, reference.times});
    for (const M measure : {M::f,
                            M::cemgil,
                            M::p,
                            M::cml_longest,
                            M::cml_total,
                            M::aml_longest,
                            M::aml_total,
                            M::information_gain,
                            M::downbeat_f,
                            M::prediction_f,
                            M::tempo_exact,
                            M::tempo_octave}) {
        EXPECT_DOUBLE_EQ(scores[measure].value(), 1.0) << info_of(measure).name;
    }
    for (const M measure : {M::time_to_lock, M::bias, M::prediction_error}) {
        EXPECT_EQ(scores[measure], 0.0) << info_of(measure).name;
    }
}

TEST(ScoreBeats, leaves_the_first_five_seconds_out_but_for_the_lock) {
    const BeatList reference = bars(60);
    BeatEstimate late{reference, std::nullopt};
    late.beats.times.erase(late.beats.times.begin(), late.beats.times.begin() + 8);
    late.beats.bar_positions.erase(late.beats.bar_positions.begin(),
                                   late.beats.bar_positions.begin() + 8);
    const BeatScores scores = score_beats(reference, late);
    EXPECT_EQ(scores[M::f], 1.0);
    EXPECT_EQ(scores[M::downbeat_f], 1.0);
    EXPECT_EQ(scores[M::time_to_lock], 4.0);
}

TEST(ScoreBeats, has_no_value_for_what_a_tracker_does_not_tell) {
    const BeatList reference = bars(60);
    const BeatScores silent = score_beats(reference, {});
    for (const M measure :
         {M::downbeat_f, M::prediction_f, M::prediction_error, M::time_to_lock, M::bias}) {
        EXPECT_EQ(silent[measure], std::nullopt) << info_of(measure).name;
    }
    EXPECT_EQ(silent[M::f], 0.0);
    // Bars that are told wrongly count, also when "unknown" is all that is told.
    BeatEstimate unsure{reference, std::vector<double>()};
    unsure.beats.bar_positions.assign(60, 0);
    const BeatScores scores = score_beats(reference, unsure);
    EXPECT_EQ(scores[M::downbeat_f], 0.0);
    EXPECT_EQ(scores[M::prediction_f], 0.0);
    EXPECT_EQ(scores[M::prediction_error], std::nullopt);
}

TEST(ScoreBeats, times_are_in_milliseconds_and_predictions_within_35) {
    const BeatList reference = bars(60);
    BeatEstimate estimate{reference, reference.times};
    for (double& time : estimate.beats.times) {
        time += 0.012;
    }
    for (double& time : *estimate.predicted) {
        time -= 0.040;
    }
    const BeatScores scores = score_beats(reference, estimate);
    EXPECT_NEAR(scores[M::bias].value(), 12.0, 1e-9);
    EXPECT_NEAR(scores[M::prediction_error].value(), 40.0, 1e-9);
    EXPECT_EQ(scores[M::prediction_f], 0.0);
}

TEST(Summarize, takes_means_of_scores_and_medians_of_times_over_those_that_have_one) {
    std::vector<BeatScores> excerpts(4);
    excerpts[0][M::f] = 1.0;
    excerpts[1][M::f] = 0.5;
    excerpts[2][M::f] = 0.0;
    excerpts[3][M::f] = 0.5;
    excerpts[0][M::time_to_lock] = 1.0;
    excerpts[1][M::time_to_lock] = 9.0;
    excerpts[3][M::time_to_lock] = 2.0;
    excerpts[1][M::downbeat_f] = 0.25;
    const BeatSummary summary = summarize(excerpts);
    EXPECT_EQ(summary.excerpts, 4U);
    EXPECT_EQ(summary.never_locked, 1U);
    EXPECT_EQ(summary.scores[M::f], 0.5);
    EXPECT_EQ(summary.scores[M::time_to_lock], 2.0);
    EXPECT_EQ(summary.scores[M::downbeat_f], 0.25);
    EXPECT_EQ(summary.scores[M::bias], std::nullopt);
    EXPECT_EQ(summarize({}).excerpts, 0U);
}

TEST(BeatMeasures, each_have_an_own_name) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < kBeatMeasures; ++i) {
        names.insert(info_of(static_cast<M>(i)).name);
    }
    EXPECT_EQ(names.size(), kBeatMeasures);
    EXPECT_EQ(info_of(M::prediction_error).name, "abspred_ms");
}

}  // namespace
}  // namespace raks::audio
