#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/music/damage/sound_augmentation.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// A corpus that is written, played and heard.
struct WrittenCorpusPlan {
    const StyleBook* styles = nullptr;              ///< that it is written in; not null
    std::vector<std::filesystem::path> soundfonts;  ///< drawn from; not empty
    enum class Families : std::uint8_t { always, held_out, all };
    Families families = Families::all;
    /// All: the dances in turn, then twice what is none of them. Own: the dances in turn as our own
    /// generator plays them, without a soundfont. Synthesized: as all, some or all instruments with
    /// sounds that are drawn for the piece.
    enum class Music : std::uint8_t { all, undanceable, own, synthesized };
    Music music = Music::all;
    int first = 0;  ///< number of the first piece
    int pieces = 70;
    double seconds = 16.0;  ///< of each
    std::uint64_t seed = 1;
    int threads = 2;
    enum class Augmentation : std::uint8_t { on, off };
    Augmentation augmentation = Augmentation::on;
    SoundEffects effects{};  ///< what may happen to a piece
    /// The same number is always the same music: what a model was learnt from can be written again.
    /// First: no lossy codecs, no lower sampling rates, no quarter tones, no oud. Second: a piece
    /// is played with one soundfont as it is. Third: no synthesized music.
    enum class Edition : std::uint8_t { first = 1, second, third, fourth };
    Edition edition = Edition::fourth;
    FeaturePlan feature_plan;
};

/// Piece n depends on the plan and n alone: any number of threads gives the same corpus. About 0.5
/// s of CPU each. Groups are "style/soundfont".
/// Errors: a soundfont cannot be read; the styles have no rhythm for a dance, or none for no dance.
[[nodiscard]] Expected<std::vector<PieceFeatures>> write_corpus(const WrittenCorpusPlan& plan);

/// What the beat tracker's training has played (`raks train beats --corpus FILE`), as far as it is
/// by the styles clearly music for a dance or clearly for none; pieces without frames and windows,
/// for the recurrent network alone. Bars of three on a piano are left out: some are waltzes.
/// Errors: as load_corpus.
[[nodiscard]] Expected<std::vector<PieceFeatures>> read_beats_corpus(
    const std::filesystem::path& file,
    const StyleBook& styles,
    WrittenCorpusPlan::Families families);

}  // namespace raks::audio
