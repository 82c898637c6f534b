#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/evaluate/reliability.hpp"
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

/// How well windows of one length are classified.
struct GenreTally {
    std::size_t windows = 0;     ///< of that length, all classes
    double macro_recall = 0.0;   ///< mean over the asked classes that occur, each piece alike
    double two_dances = 0.0;     ///< mean recall of a pair, decided between these two only
    double auroc_unknown = 0.0;  ///< "none of them" against the genres; 0.5 is chance
    /// Truth x decision, both classes: shares of the weight of the truth's windows.
    std::vector<std::vector<double>> confusion;
    std::vector<std::size_t> pieces;  ///< by class
    double calibration_error = 0.0;   ///< expected calibration error of the best class' probability
    /// Windows whose best probability lies in one bin of reliability.hpp: sums of weight, of weight
    /// x probability, and of the weight of the windows that are classified right.
    struct Bin {
        double weight = 0.0;  ///< sum of the windows' weights
        double chance = 0.0;  ///< sum of weight x probability
        double right = 0.0;   ///< sum of the weights of right windows
    };
    std::array<Bin, kReliabilityBins> reliability{};  ///< for the calibration curve
};

/// Tallies the windows of length kGenreWindows[`window`]. `log_chances`: fused ln probabilities,
/// one entry a score. `asked`: classes (at least two) between which the decision is taken and whose
/// pieces count for the recall; all others count for auroc_unknown only. `pair`: the two dances of
/// `two_dances`; empty: `two_dances` stays 0. Threads: any. Real-time: no.
[[nodiscard]] GenreTally tally(std::span<const WindowScore> scores,
                               std::span<const GenreScores::Values> log_chances,
                               std::size_t window,
                               std::span<const std::string> genres,
                               std::span<const std::size_t> asked,
                               std::span<const std::string> pair);

/// Decisions by the evidence of whole pieces.
struct PieceScores {
    std::vector<WindowScore> scores;               ///< one a piece: that of its first window
    std::vector<GenreScores::Values> log_chances;  ///< mean over the piece's windows, by score
};
/// The pieces' mean fused ln probabilities over their windows of length kGenreWindows[`window`], as
/// find_sections() (audio/song/song_dances.hpp) takes them for a song of one section without a
/// tagger. Pieces without such a window are left out. To be tallied as windows of that length.
[[nodiscard]] PieceScores whole_pieces(std::span<const WindowScore> scores,
                                       std::span<const GenreScores::Values> log_chances,
                                       std::size_t window);

}  // namespace raks::audio
