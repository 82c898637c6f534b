#pragma once

#include <cstddef>
#include <span>

#include "audio/beat/network/confidence_model.hpp"

/// Learning how sure a beat is.
namespace raks::audio {

/// A beat that was announced, and whether it was right.
struct JudgedBeat {
    ConfidenceFeatures features{};  ///< confidence_features() when it was announced
    bool is_right = false;          ///< a beat of the annotation lies within 70 ms
    std::size_t piece = 0;          ///< number of the piece that it is of
};

/// The weights with which a logistic regression fits best to how often beats were right: all pieces
/// count alike, and weights are kept small by a ridge of 1e-3. Newton's method. `beats`: not empty.
/// `wrong_counts`: as many right beats weigh as much as a wrong one; over 1 doubt is told sooner.
/// Threads: any. Real-time: no.
[[nodiscard]] ConfidenceModel fit_confidence(std::span<const JudgedBeat> beats,
                                             double wrong_counts);

}  // namespace raks::audio
