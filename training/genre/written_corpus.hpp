#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/music/damage/sound_augmentation.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Generates training music: it is written in the styles of a book, rendered and augmented, and its
/// features are extracted.
struct WrittenCorpusPlan {
    const StyleBook* styles = nullptr;  ///< styles that the music is written in; not null
    /// One, or a band of several, plays a piece; not empty.
    std::vector<std::filesystem::path> soundfonts;
    /// Which rhythms: those always used, those that may be held out, or all.
    enum class Families : std::uint8_t { always, held_out, all };
    Families families = Families::all;  ///< rhythms to draw from
    /// all: the dances in turn, then two pieces for no dance. own: the dances in turn from the
    /// built-in generator, without a soundfont. synthesized: as all, some or all instruments with
    /// synthesized sounds drawn for the piece. undanceable: music without a beat to dance to.
    enum class Music : std::uint8_t { all, undanceable, own, synthesized };
    Music music = Music::all;  ///< what is written
    int first = 0;             ///< number of the first piece
    int pieces = 70;           ///< how many
    double seconds = 16.0;     ///< of each
    std::uint64_t seed = 1;    ///< piece n draws from stream n of it
    int threads = 2;           ///< any number gives the same corpus
    /// Whether pieces are damaged (off: clean).
    enum class Augmentation : std::uint8_t { on, off };
    Augmentation augmentation = Augmentation::on;  ///< of all pieces
    SoundEffects effects{};                        ///< which kinds of damage may occur
    /// Fixes what the generator does, so that the material of an older model can be made again.
    /// first: no lossy codecs, no lower sampling rates, no quarter tones, no oud. second: a piece
    /// is played with one soundfont, unchanged. third: no synthesized music.
    enum class Edition : std::uint8_t { first = 1, second, third, fourth };
    Edition edition = Edition::fourth;  ///< of the generator
    FeaturePlan feature_plan;           ///< beat network and cepstral mean of feature extraction
};

/// Piece n depends on the plan and n alone: any number of threads gives the same corpus. About 0.5
/// s of CPU each. Groups are "style/soundfont". Errors: a soundfont cannot be read; the styles have
/// no rhythm for a dance, or none for no dance. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<PieceFeatures>> write_corpus(const WrittenCorpusPlan& plan);

/// Reads the beat tracker's training corpus (`raks train beats --corpus FILE`) and keeps the pieces
/// whose style is clearly for one dance or clearly for none. The pieces have mel magnitudes only,
/// no frames and no windows, so only the recurrent network can learn from them. Piano pieces in
/// bars of three are left out, because some are waltzes.
/// Errors: as load_corpus.
[[nodiscard]] Expected<std::vector<PieceFeatures>> read_beats_corpus(
    const std::filesystem::path& file,
    const StyleBook& styles,
    WrittenCorpusPlan::Families families);

}  // namespace raks::audio
