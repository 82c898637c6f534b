#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "apps/reports/music_table.hpp"
#include "audio/genre/tag_evidence.hpp"
#include "audio/genre/tag_source.hpp"
#include "base/json.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"

namespace raks::apps {

/// The document of `raks analyze --json` for one file: what the streaming tracker announced,
/// without look-ahead. `beats` are never revised; `predicted` are beats as committed 100 ms ahead.
/// The format is described in docs/reference/files.md (raks-analysis, version 1).
class AnalysisDocument {
 public:
    /// `genres`: names of the classes of MusicState::genre_log_probability, "unknown" last.
    AnalysisDocument(std::string file, SampleRate rate, std::vector<std::string> genres);

    /// What the file says of its dance; without it the document has no `tags`.
    void set_told(audio::TagEvidence told) { told_ = std::move(told); }

    /// Takes the next state; states come in order, one a hop.
    void add(const MusicState& state);

    /// The music is tagged: the document has tags, also where none are added.
    void expect_tags() { has_tags_ = true; }
    /// Takes the strongest tags of the music so far.
    void add_tags(const audio::TaggerWord& word);

    /// Replaces the announced beats by those of a method that had the whole file; the tempo becomes
    /// that of the beats around each moment, and nothing is predicted. After all states.
    void replace_beats(std::vector<BeatEvent> beats);

    /// The document as JSON text. `duration`: length of the audio.
    [[nodiscard]] std::string to_json(Nanos duration) const;

    /// A few lines for people: tempo, metre, beats, dance.
    [[nodiscard]] std::string to_text(Nanos duration) const;

 private:
    struct TempoPoint {
        double time;
        double bpm;
        float confidence;
        RivalTempo rival;
        int parts;  ///< MusicState::beat_parts
    };
    struct GenrePoint {
        double time;
        std::size_t label;  ///< class
        bool is_told;       ///< by the file
        GenreLogProbabilities log_probability;
    };
    /// What a row of kMusicTable says once.
    struct MusicPoint {
        double time;
        std::array<MusicValue, MusicRow::kMostFields> values;
    };

    static constexpr std::size_t kStrongest = 3;  ///< tags that a point names
    struct TagPoint {
        double time;
        std::array<std::size_t, kStrongest> tags;  ///< index in audio::kTagNames
        std::array<float, kStrongest> probabilities;
    };

    [[nodiscard]] static bool is_due(const MusicRow& row,
                                     const MusicState& state,
                                     const std::vector<MusicPoint>& written);
    void add_music(Json& document) const;
    [[nodiscard]] double median_bpm() const;

    std::string file_;
    audio::TagEvidence told_;
    SampleRate rate_;
    std::vector<std::string> genres_;
    std::vector<TempoPoint> tempo_;
    std::vector<BeatEvent> beats_;
    std::vector<double> predicted_;
    std::vector<GenrePoint> genre_;
    std::array<std::vector<MusicPoint>, kMusicTable.size()> music_;  // by row
    std::vector<TagPoint> tags_;
    bool has_tags_ = false;
    int beats_per_bar_ = 4;
};

}  // namespace raks::apps
