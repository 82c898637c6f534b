#pragma once

#include <cstddef>
#include <vector>

#include "base/dice.hpp"
#include "training/beat/corpus.hpp"
#include "training/networks/network_gradient.hpp"

namespace raks::audio {

/// Draws a batch of `chunks` stretches of `hops` hops from `from` (not empty), randomly augmented.
/// With chance `cut_chance` a second excerpt begins within a chunk. Targets lie `lookahead` hops
/// late.
/// Threads: any, each with its own dice.
[[nodiscard]] TrainingBatch draw_batch(const std::vector<const TrainingExcerpt*>& from,
                                       std::size_t chunks,
                                       std::size_t hops,
                                       int lookahead,
                                       double cut_chance,
                                       Dice& dice);

/// The first `hops` hops of `excerpts` without augmentation, one chunk each: for validation.
[[nodiscard]] TrainingBatch plain_batch(const std::vector<const TrainingExcerpt*>& excerpts,
                                        std::size_t hops,
                                        int lookahead);

}  // namespace raks::audio
