#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "audio/evaluate/genre_scores.hpp"
#include "base/music_state.hpp"
#include "training/genre/genre_trainer.hpp"

namespace raks::apps {

/// The results of a training that its report shows.
struct GenrePage {
    std::string title;                ///< of the page
    std::vector<std::string> genres;  ///< names of the classes, without "unknown"
    std::vector<std::string> pair;    ///< two that are compared; empty: none
    /// One kind of evidence at one window length.
    struct Row {
        std::string evidence;     ///< name of the evidence: "fused", "MFCC", ...
        double seconds = 0.0;     ///< of the window
        audio::GenreTally tally;  ///< its scores
    };
    std::vector<Row> rows;  ///< evidence by evidence, windows ascending
    /// One recording, with the decisions fused over windows of 5 s.
    struct File {
        std::string name;    ///< of the file
        std::string truth;   ///< name of its genre; empty: none of the dances
        double right = 0.0;  ///< share of its windows that were decided rightly, [0, 1]
    };
    std::vector<File> files;  ///< all judged recordings
};

/// The report as an HTML page: recall against window length, confusion and reliability of the fused
/// decision at 5 s, and the files that are mostly wrong. The same data give the same bytes.
/// Threads: any. Real-time: no.
[[nodiscard]] std::string draw_genre_page(const GenrePage& page);

/// For each fold, the fusion of every kind of evidence at every window length: fitted to the scores
/// of the other folds, or, where there is only one fold, to its own.
class FoldFusions {
 public:
    /// Fits all of them; `classes` includes "unknown". Takes `threads` threads.
    FoldFusions(std::span<const audio::WindowScore> scores, std::size_t classes, int threads);

    /// The fusion to use on scores of this fold. `window`: index in kGenreWindows.
    [[nodiscard]] const audio::GenreFusion& of(int fold,
                                               audio::GenreEvidence evidence,
                                               std::size_t window) const;

 private:
    std::map<int, std::vector<audio::GenreFusion>> fusions_;  // of each fold
};

/// Scores to be judged, and what fuses their evidence: the calibrated model for the fused decision
/// where there is one, else the fusion of each score's fold, which is also used for single kinds of
/// evidence.
struct JudgedScores {
    std::span<const audio::WindowScore> scores;     ///< of all windows
    const FoldFusions& fusions;                     ///< has the folds of these scores
    const audio::GenreModel* calibrated = nullptr;  ///< null: the fusions are used throughout
    std::vector<std::string> pair{};                ///< two dances that are compared; empty: none
};

/// Judges every kind of evidence at every window length. `asked`: the classes that are judged.
[[nodiscard]] GenrePage page_of(const std::string& title,
                                const JudgedScores& judged,
                                std::span<const std::string> genres,
                                std::span<const std::size_t> asked);

/// Prints the page's table to stdout, and the confusion of the fused decision at 5 s.
void print_page(const GenrePage& page, std::span<const std::size_t> asked);

/// For each recorded file the share of its 5 s windows that were decided rightly, among the classes
/// that are asked for.
[[nodiscard]] std::vector<GenrePage::File> judged_files(
    std::span<const audio::PieceFeatures> pieces,
    const JudgedScores& judged,
    std::span<const std::string> genres,
    std::span<const std::size_t> asked);

/// All classes from 0 to count - 1.
[[nodiscard]] std::vector<std::size_t> all_genres(std::size_t count);

/// Classes of the genres with recordings of at least five pieces.
[[nodiscard]] std::vector<std::size_t> enough_recordings(
    std::span<const audio::PieceFeatures> pieces, std::span<const std::string> genres);

}  // namespace raks::apps
