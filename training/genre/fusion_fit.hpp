#pragma once

#include <cstddef>
#include <span>

#include "audio/evaluate/genre_scores.hpp"
#include "audio/genre/genre_fusion.hpp"

namespace raks::audio {

/// Weights and offsets that make the chances of windows of length `window` most likely, offsets
/// pulled to 0; windows as heavy as balanced_weights() says, recordings one and a half times.
/// `scores`: of pieces that the model was not trained on. Without such windows: the default
/// weights.
[[nodiscard]] GenreFusion fit_fusion(std::span<const WindowScore> scores,
                                     std::size_t window,
                                     std::size_t classes,
                                     GenreEvidence evidence);

}  // namespace raks::audio
