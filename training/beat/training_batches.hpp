#pragma once

#include <cstddef>
#include <vector>

#include "base/dice.hpp"
#include "training/beat/corpus.hpp"
#include "training/networks/network_gradient.hpp"

namespace raks::audio {

/// `chunks` stretches of `hops` hops from excerpts drawn from `from` (not empty), as heard through
/// drawn augmentations. With `cut_chance` a chunk goes over into another excerpt, as on a stage.
[[nodiscard]] TrainingBatch draw_batch(const std::vector<const TrainingExcerpt*>& from,
                                       std::size_t chunks,
                                       std::size_t hops,
                                       int lookahead,
                                       double cut_chance,
                                       Dice& dice);

/// The first `hops` hops of `excerpts`, as they are.
[[nodiscard]] TrainingBatch plain_batch(const std::vector<const TrainingExcerpt*>& excerpts,
                                        std::size_t hops,
                                        int lookahead);

}  // namespace raks::audio
