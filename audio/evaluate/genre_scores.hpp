#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_fusion.hpp"
#include "audio/genre/genre_model.hpp"

namespace raks::audio {

/// What the parts of a model say of one window of a piece, before they are fused.
struct WindowScore : GenreScores {
    std::size_t piece = 0;    ///< index of the piece
    std::size_t truth = 0;    ///< class
    bool is_recorded = true;  ///< not written by us
    std::size_t window = 0;   ///< index into kGenreWindows
    int fold = 0;  ///< of a validation: models and fusions that judge it know others only
};

/// Class of a genre in a model: those that it does not know count as none.
[[nodiscard]] std::size_t class_of(std::string_view genre,
                                   std::span<const std::string> genres) noexcept;

/// Scores all windows of one piece by streaming it, as the recognizer does.
[[nodiscard]] std::vector<WindowScore> score_piece(const GenreModel& model,
                                                   const PieceFeatures& piece,
                                                   std::size_t piece_index);

/// How heavy each window is: classes alike, in each recordings and written music alike, in each of
/// these the pieces.
[[nodiscard]] std::vector<double> balanced_weights(std::span<const WindowScore* const> scores);

}  // namespace raks::audio
