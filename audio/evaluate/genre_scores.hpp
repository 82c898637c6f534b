#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_fusion.hpp"
#include "audio/genre/genre_model.hpp"

/// Scores of the genre model's parts on windows of music, for the fit of the fusion and for
/// evaluation. Threads: any. Real-time: no.
namespace raks::audio {

/// Scores by each part of a model for one window of a piece, before they are fused.
struct WindowScore : GenreScores {
    std::size_t piece = 0;    ///< index of the piece, as score_piece was given it
    std::size_t truth = 0;    ///< class of the piece's genre, see class_of
    bool is_recorded = true;  ///< false: written by the music generators
    std::size_t window = 0;   ///< index into kGenreWindows
    /// Validation fold: models and fusions that judge the window were trained on other folds only.
    int fold = 0;
};

/// Class of a genre in a model: its index in `genres`, or genres.size() ("none of them") where it
/// is not among them.
[[nodiscard]] std::size_t class_of(std::string_view genre,
                                   std::span<const std::string> genres) noexcept;

/// Scores of all windows of one piece, in order of the windows. Streams through the piece as
/// GenreRecognizer does, so that evaluation sees what the program computes. `piece_index`: goes
/// into WindowScore::piece.
[[nodiscard]] std::vector<WindowScore> score_piece(const GenreModel& model,
                                                   const PieceFeatures& piece,
                                                   std::size_t piece_index);

/// Weight of each window such that every class weighs the same; within a class, recordings and
/// written music; within each of these, every piece; within a piece, every window. Sums to 1.
[[nodiscard]] std::vector<double> balanced_weights(std::span<const WindowScore* const> scores);

}  // namespace raks::audio
