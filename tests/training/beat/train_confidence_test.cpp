#include "training/beat/train_confidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace raks::audio {
namespace {

float probability(const ConfidenceModel& model, const ConfidenceFeatures& features) {
    float sum = 0.0F;
    for (std::size_t i = 0; i < features.size(); ++i) {
        sum += model.weights[i] * features[i];
    }
    return 1.0F / (1.0F + std::exp(-sum));
}

TEST(TrainConfidence, finds_the_weights_that_the_beats_were_drawn_by) {
    ConfidenceModel truth;
    truth.weights = {-0.5F, 1.5F};
    const CounterRandom random(3);
    std::vector<JudgedBeat> beats;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        JudgedBeat beat;
        beat.features[0] = 1.0F;
        beat.features[1] = static_cast<float>(2.0 * random.uniform(2 * i) - 1.0);
        beat.is_right =
            random.uniform(2 * i + 1) < static_cast<double>(probability(truth, beat.features));
        beat.piece = i % 50;
        beats.push_back(beat);
    }
    const ConfidenceModel found = fit_confidence(beats, 1.0);
    EXPECT_NEAR(found.weights[0], -0.5F, 0.1F);
    EXPECT_NEAR(found.weights[1], 1.5F, 0.1F);
    for (std::size_t i = 2; i < kConfidenceFeatures; ++i) {
        EXPECT_NEAR(found.weights[i], 0.0F, 1e-3F);
    }
}

TEST(TrainConfidence, a_long_piece_counts_no_more_than_a_short_one) {
    std::vector<JudgedBeat> beats(990, {.features = {1.0F}, .is_right = true, .piece = 0});
    beats.resize(1000, {.features = {1.0F}, .is_right = false, .piece = 1});
    EXPECT_NEAR(probability(fit_confidence(beats, 1.0), {1.0F}), 0.5F, 1e-3F);
    EXPECT_NEAR(probability(fit_confidence(beats, 3.0), {1.0F}), 0.25F, 1e-3F);
}

}  // namespace
}  // namespace raks::audio
