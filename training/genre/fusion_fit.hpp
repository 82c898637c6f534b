#pragma once

#include <cstddef>
#include <span>

#include "audio/evaluate/genre_scores.hpp"
#include "audio/genre/genre_fusion.hpp"

namespace raks::audio {

/// Fits fusion weights (>= 0) and class offsets for windows of length `window` (index into
/// kGenreWindows): maximum likelihood of the true classes with an L2 penalty on the offsets.
/// Windows weigh as balanced_weights() says, recordings 1.5 times. `scores`: of pieces that the
/// model was not trained on. With no window of that length: weights of 1 for the evidence that is
/// used.
[[nodiscard]] GenreFusion fit_fusion(std::span<const WindowScore> scores,
                                     std::size_t window,
                                     std::size_t classes,
                                     GenreEvidence evidence);

}  // namespace raks::audio
