#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "audio/features/onset.hpp"
#include "audio/form/hop_sound.hpp"
#include "audio/genre/genre_recognizer.hpp"
#include "audio/music_analyzer.hpp"
#include "audio/song/beat_path.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

/// What the streaming analysis gave for each hop of a song, for the second pass over all of it.
/// About 0.5 kB a hop: 15 MB for five minutes.
struct SongRecording {
    static constexpr std::size_t kMelBands = OnsetDetector::kMelBands;  ///< numbers a hop in `mel`

    std::vector<MusicState> states;  ///< as the stream had them
    std::vector<SongHop> hops;       ///< evidence of beats, each at its own hop
    std::vector<float> mel;          ///< mel magnitudes, hops x kMelBands
    std::vector<HopSound> sounds;    ///< what the form tracker heard
    /// What the own parts said, each of the seconds before its hop; ascending.
    struct Moment {
        std::size_t hop = 0;
        GenreRecognizer::Moment said;
    };
    std::vector<Moment> moments;
    std::vector<SongJudgement::Patch> patches;  ///< what the tagger said; ascending

    /// Mel magnitudes of a hop.
    [[nodiscard]] std::span<const float, kMelBands> mel_of(std::size_t hop) const {
        return std::span(mel).subspan(hop * kMelBands).first<kMelBands>();
    }
};

/// Records a song from the analyzer's states, in order from the first.
class SongRecorder final : public MusicAnalyzer::Sink {
 public:
    /// `analyzer`: whose states come here; it must outlive this.
    explicit SongRecorder(const MusicAnalyzer& analyzer) : analyzer_(analyzer) {}

    void on_state(const MusicState& state) noexcept override;

    /// Ends the song after this many hops; later ones are dropped. Empties the recorder.
    [[nodiscard]] SongRecording take(std::size_t hops);
    /// Hops recorded so far.
    [[nodiscard]] std::size_t hops() const noexcept { return recording_.states.size(); }

 private:
    void record_genre(std::size_t hop, const GenreRecognizer& genres);

    const MusicAnalyzer& analyzer_;
    SongRecording recording_;
};

}  // namespace raks::audio
