// The whole analyzer on generated music of every style: bounds at what it reached, so that a change
// for the worse is seen. After a change for the better raise them:
//     raks_tests_audio --gtest_filter='BeatRegression*'
#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "audio/evaluate/beat_scores.hpp"
#include "tests/audio/listen.hpp"

namespace raks::audio {
namespace {

BeatScores scores_of(const GeneratedMusic& piece) {
    BeatList reference;
    for (const ReferenceBeat& beat : piece.beats) {
        reference.times.push_back(to_seconds(beat.time));
        reference.bar_positions.push_back(beat.bar_position);
    }
    BeatEstimate estimate;
    estimate.predicted.emplace();
    for (const MusicState& state : test::listen(piece)) {
        if (state.has_beat) {
            estimate.beats.times.push_back(to_seconds(state.beat.time));
            estimate.beats.bar_positions.push_back(state.beat.bar_position);
        }
        if (state.has_predicted) {
            estimate.predicted->push_back(to_seconds(state.predicted));
        }
    }
    return score_beats(reference, estimate);
}

struct Bound {
    BeatMeasure measure;
    double least;  ///< of the mean over the pieces
};

void expect_at_least(const char* what,
                     const std::vector<GeneratedMusic>& pieces,
                     const std::vector<Bound>& bounds) {
    std::vector<BeatScores> scores;
    scores.reserve(pieces.size());
    for (const GeneratedMusic& piece : pieces) {
        scores.push_back(scores_of(piece));
    }
    const BeatScores mean = summarize(scores).scores;
    for (const auto& [measure, least] : bounds) {
        const double value = mean[measure].value_or(0.0);
        const auto name = info_of(measure).name;
        std::printf("%-8s %-6.*s %.4f\n", what, static_cast<int>(name.size()), name.data(), value);
        EXPECT_GE(value, least) << what << ' ' << name;
    }
}

using M = BeatMeasure;

std::vector<GeneratedMusic> steady(Style style, const std::vector<double>& tempi) {
    std::vector<GeneratedMusic> pieces;
    pieces.reserve(tempi.size());
    for (const double bpm : tempi) {
        pieces.push_back(test::music(style, {{0.0, bpm}}, 30.0));
    }
    return pieces;
}

TEST(BeatRegression, is_no_worse_than_it_was) {
    expect_at_least(
        "drums",
        steady(Style::drums, {70.0, 95.0, 120.0, 150.0, 180.0}),
        {{M::f, 0.98}, {M::cml_total, 0.97}, {M::prediction_f, 0.98}, {M::downbeat_f, 0.96}});
    expect_at_least(
        "salsa",
        steady(Style::montuno, {165.0, 185.0, 205.0}),
        {{M::f, 0.99}, {M::cml_total, 0.98}, {M::prediction_f, 0.99}, {M::downbeat_f, 0.99}});
    expect_at_least(
        "maqsum",
        steady(Style::maqsum, {90.0, 110.0, 130.0}),
        {{M::f, 0.98}, {M::cml_total, 0.97}, {M::prediction_f, 0.98}, {M::downbeat_f, 0.78}});
    expect_at_least(
        "house",
        steady(Style::four_on_the_floor, {118.0, 126.0}),
        {{M::f, 0.98}, {M::cml_total, 0.97}, {M::prediction_f, 0.98}, {M::downbeat_f, 0.98}});
    expect_at_least(
        "changing",
        {test::music(Style::montuno, {{0.0, 150.0}, {12.0, 215.0}}, 24.0),
         test::music(Style::drums, {{0.0, 120.0}, {15.0, 120.0}, {15.0, 142.0}}, 30.0),
         test::music(Style::four_on_the_floor, {{0.0, 132.0}, {25.0, 112.0}}, 25.0)},
        {{M::f, 0.99}, {M::cml_total, 0.98}, {M::prediction_f, 0.97}, {M::downbeat_f, 0.94}});
}

}  // namespace
}  // namespace raks::audio
