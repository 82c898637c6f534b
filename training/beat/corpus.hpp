#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "audio/music/score/performance.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// One excerpt as the network's front end hears it.
struct TrainingExcerpt {
    std::string
        family;  ///< of music, to leave it out: "salsa", "pop", "piano", ...; "none": no music
    std::string style;       ///< within it: a rhythm's name, "groove rock", "own salsa", "lied"
    std::vector<float> mel;  ///< hops x 36 magnitudes, 10 ms a hop
    std::vector<PlayedBeat> beats;
    [[nodiscard]] std::size_t hops() const { return mel.size() / 36; }
};

struct CorpusPlan {
    const StyleBook* styles = nullptr;              ///< that music is written in; not null
    std::filesystem::path pack;                     ///< MIDI with its index, see read_midi_pack
    std::vector<std::filesystem::path> soundfonts;  ///< not empty; several: see draw_soundfonts
    int excerpts = 1400;
    double seconds = 22.0;       ///< of each
    bool with_machines = false;  ///< more electronic music, most of it as machines play it, and
                                 ///< styles at tempi that they are seldom danced at
    std::uint64_t seed = 1;
    int threads = 2;
};

/// A piece of music as it sounds.
struct CorpusPiece {
    std::string family;  ///< as TrainingExcerpt's
    std::string style;
    std::vector<float> samples;  ///< mono, SoundfontPlayer::kRate
    std::vector<PlayedBeat> beats;
};

/// Writes music and plays it: piece n depends on the plan's seed and n alone, so any number of
/// threads gives the same pieces. `take(n, piece)` gets each, from several threads; its first error
/// ends all. About 0.4 s of CPU each.
/// Errors: the pack or a soundfont cannot be read; the styles have no rhythm for it.
[[nodiscard]] Expected<void> make_pieces(
    const CorpusPlan& plan, const std::function<Expected<void>(int, CorpusPiece)>& take);

/// Each piece as the network's front end hears it. Errors: as make_pieces.
[[nodiscard]] Expected<std::vector<TrainingExcerpt>> make_corpus(const CorpusPlan& plan);

/// A corpus kept between runs; numbers as this machine stores them.
/// Errors of reading: not such a file, cut short, sizes that do not fit together.
[[nodiscard]] Expected<void> save_corpus(const std::vector<TrainingExcerpt>& corpus,
                                         const std::filesystem::path& path);
[[nodiscard]] Expected<std::vector<TrainingExcerpt>> load_corpus(const std::filesystem::path& path);

}  // namespace raks::audio
