#pragma once

#include <string>
#include <vector>

#include "audio/evaluate/genre_tally.hpp"

namespace raks::apps {

/// What a training report shows.
struct GenrePage {
    std::string title;
    std::vector<std::string> genres;
    std::vector<std::string> pair;  ///< two that are compared; empty: none
    struct Row {
        std::string evidence;
        double seconds = 0.0;  ///< of the window
        audio::GenreTally tally;
    };
    std::vector<Row> rows;
    /// How often the fused decision of 5 s was right for each file.
    struct File {
        std::string name;
        std::string truth;
        double right = 0.0;
    };
    std::vector<File> files;
};

/// Its HTML: recall against window length, confusion and reliability
/// of the fused decision at 5 s, and the files that fail. The same data give the same bytes.
[[nodiscard]] std::string draw_genre_page(const GenrePage& page);

}  // namespace raks::apps
