#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audio/evaluate/form_scores.hpp"
#include "audio/evaluate/repeat_scores.hpp"

namespace raks::apps {

/// What was missed and wrongly told in one song.
struct SongFaults {
    std::string song;         ///< its name
    audio::FormFaults live;   ///< as it came
    audio::FormFaults ahead;  ///< of the whole song
};

/// How well it was told what music does.
struct MusicReport {
    std::string songs = "generated songs";  ///< which they are
    double minutes = 0.0;                   ///< of songs
    audio::FormScores live;                 ///< as it came
    audio::FormScores ahead;                ///< of the whole song, before it sounded
    std::vector<SongFaults> each;           ///< where the report is to name them
    /// By style: bars of parts that come again, in songs that are known; of annotated songs
    /// nothing.
    std::vector<std::pair<std::string_view, audio::RepeatScore>> repeats;
};

/// A table by event for each way, and the faults of each song.
[[nodiscard]] std::string to_text(const MusicReport& report);
/// raks-eval-music, version 1 (docs/reference/files.md).
[[nodiscard]] std::string to_json(const MusicReport& report);

}  // namespace raks::apps
