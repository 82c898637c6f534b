#include "training/genre/fusion_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace raks::audio {
namespace {

constexpr std::size_t kWeights = 4;  // numbers in EvidenceWeights
// Weights of the dances, weights of none, an offset a class.
constexpr std::size_t kNumbers = 2 * kWeights + PatternNetwork::kMaxClasses;
using Numbers = std::array<double, kNumbers>;

// Weight of a recording against a written piece, because recordings are what is danced to. A higher
// weight improves recordings further, but then the generator's own maqsum is classified as hip-hop
// for seconds.
constexpr double kRecordedWeight = 1.5;
// L2 penalty, nats a squared nat: a few clips must not tilt a class.
constexpr double kOffsetPull = 0.1;

// Order of the weights within the vector of numbers: mfcc, rhythm, sound, network.
EvidenceWeights weights_of(const double* numbers) {
    return {static_cast<float>(numbers[0]),
            static_cast<float>(numbers[1]),
            static_cast<float>(numbers[2]),
            static_cast<float>(numbers[3])};
}

/// Unpacks the vector: weights of the dances, of none of them, then the offsets.
GenreFusion fusion_of(const Numbers& numbers) {
    GenreFusion fusion{weights_of(numbers.data()), weights_of(numbers.data() + kWeights), {}};
    std::transform(
        numbers.begin() + 2 * kWeights, numbers.end(), fusion.offsets.begin(), [](double offset) {
            return static_cast<float>(offset);
        });
    return fusion;
}

/// 1 for each weight whose evidence is used, 0 for the others.
std::array<double, kWeights> mask_of(GenreEvidence evidence) {
    return {uses_mfcc(evidence) ? 1.0 : 0.0,
            uses_rhythm(evidence) ? 1.0 : 0.0,
            uses_sound(evidence) ? 1.0 : 0.0,
            uses_network(evidence) ? 1.0 : 0.0};
}

/// Gradient of the mean negative log-likelihood plus the L2 penalty, by every number. Softmax: by a
/// class' sum it is probability minus target.
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
            // One-hot target; shares sum to 1 over all windows.
            const double wanted = c == score.truth ? 1.0 : 0.0;
            const double error = shares[i] * (std::exp(static_cast<double>(logs[c])) - wanted);
            // The last class is none of the dances and has weights of its own.
            double* const weights = slope.data() + (c + 1 == classes ? kWeights : 0);
            weights[0] += error * static_cast<double>(mfcc[c]);
            weights[1] += error * static_cast<double>(score.rhythm[c]);
            weights[2] += error * static_cast<double>(score.sound[c]);
            weights[3] += error * static_cast<double>(score.network[c]);
            slope[2 * kWeights + c] += error;
        }
    }
    // The penalty is on the offsets only.
    for (std::size_t k = 2 * kWeights; k < kNumbers; ++k) {
        slope[k] += 2.0 * kOffsetPull * numbers[k];
    }
    return slope;
}

/// Weight of each window in the mean: balanced, recordings heavier, sum 1.
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
    // Starts from weights of 1 for the evidence that is used and 0 for the rest.
    const std::array<double, kWeights> mask = mask_of(evidence);
    Numbers numbers{};
    std::copy(mask.begin(), mask.end(), numbers.begin());
    std::copy(mask.begin(), mask.end(), numbers.begin() + kWeights);
    const std::vector<double> shares = shares_of(used);
    // Adam (Kingma, Ba 2015) on all windows at once. The log-likelihood is concave in the numbers,
    // so no optimum is merely local; the rate falls linearly to 0.
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
        // Projection: unused evidence stays at 0, and no weight may become negative.
        for (std::size_t k = 0; k < 2 * kWeights; ++k) {
            numbers[k] = mask[k % kWeights] * std::max(0.0, numbers[k]);
        }
    }
    return fusion_of(numbers);
}

}  // namespace raks::audio
