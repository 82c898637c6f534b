#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "audio/music/score/score.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/expected.hpp"

/// The training corpus of the beat tracker: generated music with known beats.
namespace raks::audio {

/// Features and annotated beats of one generated excerpt.
struct TrainingExcerpt {
    /// A class of music that can be left out: "salsa", "pop", "piano", ...; "none": no music.
    std::string family;
    std::string style;  ///< finer than family: a rhythm's name, "groove rock", "own salsa", "lied"
    std::vector<float> mel;         ///< hops x 36 magnitudes, row-major; a hop is 10 ms
    std::vector<PlayedBeat> beats;  ///< annotated; seconds from the first hop
    /// Hops in `mel`.
    [[nodiscard]] std::size_t hops() const { return mel.size() / 36; }
};

/// What music is generated.
struct CorpusPlan {
    const StyleBook* styles = nullptr;              ///< styles that music is written in; not null
    std::filesystem::path pack;                     ///< MIDI with its index, see read_midi_pack
    std::vector<std::filesystem::path> soundfonts;  ///< not empty; several: see draw_soundfonts
    int excerpts = 1400;                            ///< how many pieces
    double seconds = 22.0;                          ///< of each
    /// More electronic music, most of it played by machines, and some styles at tempi at which they
    /// are seldom danced.
    bool with_machines = false;
    /// Metres that are easily misheard: compound and additive ones, triplets over straight beats,
    /// loud off-beats, slow music, strings, claps (audio/music/score/metre_variations.hpp).
    bool with_metres = false;
    std::uint64_t seed = 1;  ///< piece n draws from stream n of it
    int threads = 2;         ///< any number gives the same pieces
};

/// A rendered piece with its beats.
struct CorpusPiece {
    std::string family;             ///< as in TrainingExcerpt
    std::string style;              ///< as in TrainingExcerpt
    std::vector<float> samples;     ///< mono, kPerformanceRate
    std::vector<PlayedBeat> beats;  ///< annotated; empty: not music, or without a pulse
};

/// Writes and renders music: piece n depends on the plan and n alone, so any number of threads
/// gives the same pieces. `take(n, piece)` receives each, called from several threads; after an
/// error of its own a thread takes no further piece. About 0.4 s of CPU each.
/// Errors: the pack or a soundfont cannot be read; the styles have no rhythm for it.
[[nodiscard]] Expected<void> make_pieces(
    const CorpusPlan& plan, const std::function<Expected<void>(int, CorpusPiece)>& take);

/// The mel features of each piece. Errors: as make_pieces.
[[nodiscard]] Expected<std::vector<TrainingExcerpt>> make_corpus(const CorpusPlan& plan);

/// Writes a corpus to be read again; numbers are stored in this machine's byte order. Errors: the
/// file cannot be written.
[[nodiscard]] Expected<void> save_corpus(const std::vector<TrainingExcerpt>& corpus,
                                         const std::filesystem::path& path);
/// Errors: not such a file, another version, cut short, sizes that do not fit together, over 4 GiB.
[[nodiscard]] Expected<std::vector<TrainingExcerpt>> load_corpus(const std::filesystem::path& path);

/// Writes the generated pieces that have beats into a new folder in the layout of load_beat_corpus:
/// index.tsv (its class is the family), and NAME.wav and NAME.beats for each piece. On an error
/// there is no folder. With another seed and other soundfonts than in training, trackers can be
/// evaluated on music that nothing was trained on. Errors: as make_pieces and
/// PendingFile::create_folder.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<void> write_music_folder(const CorpusPlan& plan,
                                                const std::filesystem::path& folder);

}  // namespace raks::audio
