#include "training/genre/fusion_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace raks::audio {
namespace {

constexpr std::size_t kWeights = 4;  // of EvidenceWeights
constexpr std::size_t kNumbers = 2 * kWeights + PatternNetwork::kMaxClasses;
using Numbers = std::array<double, kNumbers>;

// People dance to recordings. More weight does recordings better still, and takes our own
// maqsum for hip-hop for seconds.
constexpr double kRecordedWeight = 1.5;
constexpr double kOffsetPull = 0.1;  // nats a squared nat: a few clips must not tilt a class

EvidenceWeights weights_of(const double* numbers) {
    return {static_cast<float>(numbers[0]),
            static_cast<float>(numbers[1]),
            static_cast<float>(numbers[2]),
            static_cast<float>(numbers[3])};
}

/// Numbers are the weights of the dances, of none of them, then the offsets.
GenreFusion fusion_of(const Numbers& numbers) {
    GenreFusion fusion{weights_of(numbers.data()), weights_of(numbers.data() + kWeights), {}};
    std::transform(
        numbers.begin() + 2 * kWeights, numbers.end(), fusion.offsets.begin(), [](double offset) {
            return static_cast<float>(offset);
        });
    return fusion;
}

/// 1 for each weight that the evidence has.
std::array<double, kWeights> mask_of(GenreEvidence evidence) {
    return {uses_mfcc(evidence) ? 1.0 : 0.0,
            uses_rhythm(evidence) ? 1.0 : 0.0,
            uses_sound(evidence) ? 1.0 : 0.0,
            uses_network(evidence) ? 1.0 : 0.0};
}

/// Slope of the mean negative log-likelihood and the offsets' pull.
Numbers slope_of(std::span<const WindowScore* const> scores,
                 const std::vector<double>& shares,
                 const Numbers& numbers,
                 GenreEvidence evidence,
                 std::size_t classes) {
    const GenreFusion fusion = fusion_of(numbers);
    Numbers slope{};
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const WindowScore& score = *scores[i];
        const auto logs = fuse(score, fusion, evidence, classes);
        const auto mfcc = nats_above_background(score, evidence, classes);
        for (std::size_t c = 0; c < classes; ++c) {
            const double wanted = c == score.truth ? 1.0 : 0.0;
            const double error = shares[i] * (std::exp(static_cast<double>(logs[c])) - wanted);
            double* const weights = slope.data() + (c + 1 == classes ? kWeights : 0);
            weights[0] += error * static_cast<double>(mfcc[c]);
            weights[1] += error * static_cast<double>(score.rhythm[c]);
            weights[2] += error * static_cast<double>(score.sound[c]);
            weights[3] += error * static_cast<double>(score.network[c]);
            slope[2 * kWeights + c] += error;
        }
    }
    for (std::size_t k = 2 * kWeights; k < kNumbers; ++k) {
        slope[k] += 2.0 * kOffsetPull * numbers[k];
    }
    return slope;
}

/// Each window's share of all.
std::vector<double> shares_of(std::span<const WindowScore* const> scores) {
    std::vector<double> shares = balanced_weights(scores);
    double sum = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] *= scores[i]->is_recorded ? kRecordedWeight : 1.0;
        sum += shares[i];
    }
    for (double& share : shares) {
        share /= sum;
    }
    return shares;
}

}  // namespace

GenreFusion fit_fusion(std::span<const WindowScore> scores,
                       std::size_t window,
                       std::size_t classes,
                       GenreEvidence evidence) {
    std::vector<const WindowScore*> used;
    for (const WindowScore& score : scores) {
        if (score.window == window) {
            used.push_back(&score);
        }
    }
    const std::array<double, kWeights> mask = mask_of(evidence);
    Numbers numbers{};
    std::copy(mask.begin(), mask.end(), numbers.begin());
    std::copy(mask.begin(), mask.end(), numbers.begin() + kWeights);
    const std::vector<double> shares = shares_of(used);
    // Adam (Kingma, Ba 2015); the likelihood is concave in the numbers.
    Numbers first{};
    Numbers second{};
    constexpr int kSteps = 400;
    for (int step = 1; step <= kSteps && !used.empty(); ++step) {
        const Numbers slope = slope_of(used, shares, numbers, evidence, classes);
        const double rate = 0.08 * (1.0 - static_cast<double>(step) / (kSteps + 1));
        for (std::size_t k = 0; k < kNumbers; ++k) {
            first[k] = 0.9 * first[k] + 0.1 * slope[k];
            second[k] = 0.99 * second[k] + 0.01 * slope[k] * slope[k];
            numbers[k] -= rate * first[k] / (1.0 - std::pow(0.9, step)) /
                          (std::sqrt(second[k] / (1.0 - std::pow(0.99, step))) + 1e-9);
        }
        for (std::size_t k = 0; k < 2 * kWeights; ++k) {
            numbers[k] = mask[k % kWeights] * std::max(0.0, numbers[k]);
        }
    }
    return fusion_of(numbers);
}

}  // namespace raks::audio
