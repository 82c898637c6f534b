#pragma once

#include <array>
#include <cstddef>

namespace raks::audio {

/// What a beat's confidence follows from, see confidence_features().
inline constexpr std::size_t kConfidenceFeatures = 15;
using ConfidenceFeatures = std::array<float, kConfidenceFeatures>;

/// Logistic regression from the features to the probability that a beat is right, fitted to how
/// often beats were right (raks train beats --judge; docs/how_it_works/beat.md). A value.
struct ConfidenceModel {
    /// Those of a file without any: of the margins over rivals alone.
    ConfidenceFeatures weights{
        -0.3F, 0.1F, 0.6F, 0.6F, 0.0F, 0.0F, 0.0F, 0.3F, 0.0F, 0.3F, 0.5F, 0.3F, -0.8F, 0.3F, 0.5F};
};

}  // namespace raks::audio
