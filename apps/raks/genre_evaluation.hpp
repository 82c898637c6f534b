// What `raks eval genre` reports.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/reports/genre_track.hpp"
#include "audio/evaluate/genre_scores.hpp"

/// Threads: any. Real-time: no.
namespace raks::apps {

/// Everything that is reported of a folder of music.
struct GenreEvaluation {
    /// One row of the tables: a kind of evidence at a window length, after a kind of damage.
    struct Row {
        std::string damage;
        std::string evidence;
        double seconds = 0.0;  ///< of the window
        audio::GenreTally tally;
    };
    /// What would be shown of a file.
    struct File {
        std::string name;
        std::string genre;                          ///< empty: none of the dances
        ByVoice<std::optional<ShownDance>> shown;   ///< by each who has something to say
        ByVoice<std::vector<audio::Claim>> claims;  ///< with which confidence; see shown_claims()
    };

    std::vector<std::string> genres;
    std::vector<std::string> pair;   ///< two that are compared
    std::vector<std::size_t> asked;  ///< classes that are judged
    std::vector<Row> rows;           ///< none: no file could be judged
    std::vector<File> shown;
    std::vector<std::string> skipped;  ///< files that could not be used, with the reason
    std::size_t files = 0;
};

/// The document raks-eval-genre, version 1.
[[nodiscard]] std::string genre_evaluation_json(const GenreEvaluation& evaluation);
/// The table of all rows, and what is shown by whom.
[[nodiscard]] std::string genre_evaluation_text(const GenreEvaluation& evaluation);

}  // namespace raks::apps
