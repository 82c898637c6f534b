#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "audio/genre/pattern_network.hpp"
#include "audio/genre/training/heard_piece.hpp"

namespace raks::audio {

struct PatternTrainingPlan {
    int units = 48;
    int steps = 4'000;  ///< batches of 64 windows
    double rate = 1.5e-3;
    double weight_decay = 3e-4;
    double input_dropout = 0.25;
    double hidden_dropout = 0.3;
    double recorded_share = 0.5;  ///< of a batch's windows, where a class has recordings
    std::uint64_t seed = 1;
};

/// Trains the network that tells classes by bar patterns: every class is drawn alike often, every
/// piece of a class alike often. `classes[i]`: of pieces[i], below `class_count`. Same plan, same
/// pieces: same bits. Classes without pieces are never learnt.
[[nodiscard]] PatternNetwork train_patterns(std::span<const HeardPiece* const> pieces,
                                            std::span<const std::size_t> classes,
                                            std::size_t class_count,
                                            const PatternTrainingPlan& plan);

}  // namespace raks::audio
