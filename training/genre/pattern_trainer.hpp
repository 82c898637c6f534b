#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/pattern_network.hpp"

namespace raks::audio {

struct PatternTrainingPlan {
    std::vector<std::string_view> parts;  ///< of BarPatterns::kParts that are heard; empty: all
    int units = 48;                       ///< 0: logistic regression
    int steps = 3'000;                    ///< batches of 64 windows
    double rate = 1.5e-3;
    double weight_decay = 1e-3;  ///< L2, added to a window's mean slope
    double input_dropout = 0.25;
    double hidden_dropout = 0.3;
    double recorded_share = 0.5;  ///< of a batch's windows, where a class has recordings
    std::uint64_t seed = 1;
};

/// What tells dances by rhythm, and by sound. Chosen by artist on the dev recordings: the patterns
/// over the bar carry the written genres, but mislead on recordings unless kept apart from what the
/// spectrum says (docs/how_it_works/genre.md).
[[nodiscard]] PatternTrainingPlan rhythm_training();
[[nodiscard]] PatternTrainingPlan sound_training();

/// Trains the network that tells classes by bar patterns: every class is drawn alike often, every
/// piece of a class alike often. `classes[i]`: of pieces[i], below `class_count`. Same plan, same
/// pieces: same bits. Classes without pieces are never learnt.
[[nodiscard]] PatternNetwork train_patterns(std::span<const HeardPiece* const> pieces,
                                            std::span<const std::size_t> classes,
                                            std::size_t class_count,
                                            const PatternTrainingPlan& plan);

}  // namespace raks::audio
