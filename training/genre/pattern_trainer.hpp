#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/pattern_network.hpp"

/// Training of the classifiers on bar patterns of a genre model.
namespace raks::audio {

/// How a network on bar patterns is trained.
struct PatternTrainingPlan {
    std::vector<std::string_view> parts;  ///< of BarPatterns::kParts that are inputs; empty: all
    int units = 48;                       ///< hidden; 0: logistic regression
    int steps = 3'000;                    ///< batches of 64 windows
    double rate = 1.5e-3;                 ///< highest learning rate (Adam)
    double weight_decay = 1e-3;           ///< L2 penalty, added to the mean gradient
    double input_dropout = 0.25;          ///< share of the inputs set to 0
    double hidden_dropout = 0.3;          ///< share of the hidden units set to 0
    double recorded_share = 0.5;  ///< share of a batch's windows, for classes with recordings
    std::uint64_t seed = 1;       ///< of weights and draws
};

/// Plan of the network on rhythm features. Which features belong to rhythm and which to sound was
/// chosen by cross-validation by artist on the dev recordings: bar patterns tell the written genres
/// apart, but mislead on recordings when mixed with the spectrum's features
/// (docs/decisions/0009-genre-evidence-left-out.md).
[[nodiscard]] PatternTrainingPlan rhythm_training();
/// Plan of the classifier on sound features.
[[nodiscard]] PatternTrainingPlan sound_training();

/// Trains the classifier on bar patterns: every class is drawn equally often, and every piece of a
/// class equally often. `classes[i]`: class of pieces[i], below `class_count`. The same plan and
/// pieces give the same bits. Classes without pieces are never a training target. Real-time: no.
[[nodiscard]] PatternNetwork train_patterns(std::span<const PieceFeatures* const> pieces,
                                            std::span<const std::size_t> classes,
                                            std::size_t class_count,
                                            const PatternTrainingPlan& plan);

}  // namespace raks::audio
