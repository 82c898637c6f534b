#pragma once

#include <string>
#include <vector>

#include "audio/evaluate/genre_scores.hpp"

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

}  // namespace raks::apps
