#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "audio/genre/genre_model.hpp"
#include "audio/genre/genre_recognizer.hpp"
#include "audio/genre/training/heard_piece.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// What the parts of a model say of one window, before they are fused. Classes as in GenreModel.
struct WindowScore {
    std::size_t piece = 0;    ///< index of the piece
    std::size_t truth = 0;    ///< class
    bool is_recorded = true;  ///< not written by us
    std::size_t window = 0;   ///< index into kGenreWindows
    using Values = std::array<float, PatternNetwork::kMaxClasses>;
    Values mfcc{};        ///< nats a frame
    Values similarity{};  ///< the same without the frames that all genres share; all 0 without such
                          ///< a model
    Values rhythm{};      ///< ln chance
    Values sound{};       ///< ln chance
    Values network{};     ///< mean ln chance of the hops
};

/// Class of a genre in a model: those that it does not know count as none.
[[nodiscard]] std::size_t class_of(Genre genre, std::span<const Genre> genres) noexcept;

/// Scores all windows of one piece by streaming it, as the recognizer does.
[[nodiscard]] std::vector<WindowScore> score_piece(const GenreModel& model,
                                                   const HeardPiece& piece,
                                                   std::size_t piece_index);

/// Weights that make the chances of windows of length `window` most likely: classes alike heavy, in
/// each recordings and written music alike, in each of these the pieces. `scores`: of pieces that
/// the model was not trained on. Without such windows: the default weights.
[[nodiscard]] GenreFusion fit_fusion(std::span<const WindowScore> scores,
                                     std::size_t window,
                                     std::size_t classes,
                                     GenreEvidence evidence);

/// ln chances of a window by some of the evidence.
[[nodiscard]] WindowScore::Values fuse(const WindowScore& score,
                                       const GenreFusion& fusion,
                                       GenreEvidence evidence,
                                       std::size_t classes);

/// How well windows of one length are told apart.
struct GenreTally {
    std::size_t windows = 0;
    double macro_recall = 0.0;   ///< mean over the classes asked for that occur, each piece alike
    double two_dances = 0.0;     ///< salsa against belly, only these two asked for
    double auroc_unknown = 0.0;  ///< none of the genres against the genres; 0.5 is chance
    std::vector<std::vector<double>>
        confusion;                    ///< truth x decision, shares of the truth's windows
    std::vector<std::size_t> pieces;  ///< of each class
    double calibration_error = 0.0;   ///< expected, of the best class' chance
    /// Windows whose best chance lies in one tenth: sums of weight, of weight x chance, of the
    /// weight of those that are right.
    struct Bin {
        double weight = 0.0;
        double chance = 0.0;
        double right = 0.0;
    };
    std::array<Bin, 10> reliability{};
};

/// `asked`: classes whose pieces count for the recall and between which it is decided (at least
/// two); the others count for auroc_unknown alone.
[[nodiscard]] GenreTally tally(std::span<const WindowScore> scores,
                               std::span<const WindowScore::Values> log_chances,
                               std::size_t window,
                               std::span<const Genre> genres,
                               std::span<const std::size_t> asked);

}  // namespace raks::audio
