#include "training/beat/train_confidence.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <map>

namespace raks::audio {
namespace {

constexpr int kNewtonSteps = 100;
constexpr double kRidge = 1e-3;
constexpr auto kCount = static_cast<Eigen::Index>(kConfidenceFeatures);
using Weights = Eigen::Matrix<double, kCount, 1>;
using Curvature = Eigen::Matrix<double, kCount, kCount>;

Weights features_of(const JudgedBeat& beat) {
    Weights features;
    for (Eigen::Index i = 0; i < kCount; ++i) {
        features[i] = static_cast<double>(beat.features[static_cast<std::size_t>(i)]);
    }
    return features;
}

}  // namespace

ConfidenceModel fit_confidence(std::span<const JudgedBeat> beats, double wrong_counts) {
    std::map<std::size_t, double> beats_of_piece;
    for (const JudgedBeat& beat : beats) {
        ++beats_of_piece[beat.piece];
    }
    const auto pieces = static_cast<double>(beats_of_piece.size());
    Weights weights = Weights::Zero();
    for (int step = 0; step < kNewtonSteps; ++step) {
        Weights slope = kRidge * weights;
        Curvature curvature = kRidge * Curvature::Identity();
        for (const JudgedBeat& beat : beats) {
            const Weights features = features_of(beat);
            const double share =
                (beat.is_right ? 1.0 : wrong_counts) / (beats_of_piece[beat.piece] * pieces);
            const double probability = 1.0 / (1.0 + std::exp(-weights.dot(features)));
            slope += share * (probability - (beat.is_right ? 1.0 : 0.0)) * features;
            curvature +=
                share * probability * (1.0 - probability) * features * features.transpose();
        }
        weights -= curvature.ldlt().solve(slope);
    }
    ConfidenceModel model;
    for (Eigen::Index i = 0; i < kCount; ++i) {
        model.weights[static_cast<std::size_t>(i)] = static_cast<float>(weights[i]);
    }
    return model;
}

}  // namespace raks::audio
