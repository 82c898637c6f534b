#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "apps/reports/genre_page.hpp"
#include "base/music_state.hpp"
#include "training/genre/genre_trainer.hpp"

namespace raks::apps {

/// A fusion of each kind of evidence at every window length for each fold: fitted to the scores of
/// the other folds, or, where there is but one, to its own.
class FoldFusions {
 public:
    FoldFusions(std::span<const audio::WindowScore> scores, std::size_t classes, int threads);

    [[nodiscard]] const audio::GenreFusion& of(int fold,
                                               audio::GenreEvidence evidence,
                                               std::size_t window) const;

 private:
    std::map<int, std::vector<audio::GenreFusion>> fusions_;  // of each fold
};

/// Scores, and what fuses them where there is no calibrated model or where only some of its
/// evidence speaks. `fusions`: of these folds.
struct JudgedScores {
    std::span<const audio::WindowScore> scores;
    const FoldFusions& fusions;
    const audio::GenreModel* calibrated = nullptr;
    std::vector<std::string> pair{};  ///< two dances that are compared; empty: none
};

/// How every kind of evidence does at every window length, asked among these genres.
[[nodiscard]] GenrePage page_of(const std::string& title,
                                const JudgedScores& judged,
                                std::span<const std::string> genres,
                                std::span<const std::size_t> asked);

/// The page as a table on stdout.
void print_page(const GenrePage& page, std::span<const std::size_t> asked);

/// How often each recorded file's windows of 5 s were taken for what they are, among the asked.
[[nodiscard]] std::vector<GenrePage::File> judged_files(
    std::span<const audio::PieceFeatures> pieces,
    const JudgedScores& judged,
    std::span<const std::string> genres,
    std::span<const std::size_t> asked);

[[nodiscard]] std::vector<std::size_t> all_genres(std::size_t count);

/// Genres with recordings of at least five pieces.
[[nodiscard]] std::vector<std::size_t> enough_recordings(
    std::span<const audio::PieceFeatures> pieces, std::span<const std::string> genres);

}  // namespace raks::apps
