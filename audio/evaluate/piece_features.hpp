#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audio/features/mfcc.hpp"
#include "audio/genre/bar_patterns.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/packer.hpp"
#include "base/time.hpp"

/// Features of pieces of music, as genre training and evaluation use them: the analyzer's, computed
/// once and kept in files.
/// Threads: any; each call by itself. Real-time: no.
namespace raks::audio {

class BeatNetwork;  // audio/beat/network/beat_network.hpp

/// A genre's name for people: "unknown" for music for none of the dances.
[[nodiscard]] constexpr std::string_view shown_genre(std::string_view genre) noexcept {
    return genre.empty() ? "unknown" : genre;
}

/// Bar-pattern features of one window of a piece.
struct WindowFeatures {
    int segments = 1;   ///< length in half seconds: one of kGenreWindows
    int end_frame = 0;  ///< number of the piece's frames before the window's end
    std::array<float, BarPatterns::kFeatures> features{};  ///< as BarPatterns::features gives them
};

/// Features of one piece, hops of silence left out: what genre models are trained on.
struct PieceFeatures {
    std::string name;   ///< of the file or written piece
    std::string group;  ///< artist; of written music its style and soundfont: one fold
    std::string genre;  ///< name of a dance; empty: none of the dances
    /// Where the sound came from.
    enum class Kind : std::uint8_t {
        recorded,
        altered,  ///< a recording after augmentation, for training and fits
        written,
        written_held_out  ///< its family of arrangements may be left out of training
    };
    Kind kind = Kind::recorded;           ///< where the sound came from
    std::vector<MfccVector> frames;       ///< MFCC-39 of each hop, cepstral mean taken off
    std::vector<float> mel;               ///< hops x kMelBands magnitudes, noise removed, row-major
    std::vector<WindowFeatures> windows;  ///< one set a second, of each length that is full

    /// Hops of music, which is also the number of frames.
    [[nodiscard]] std::size_t hops() const noexcept {
        return mel.size() / static_cast<std::size_t>(BarPatterns::kMelBands);
    }
    /// Recordings, altered or not; false for written music.
    [[nodiscard]] bool is_recorded() const noexcept {
        return kind == Kind::recorded || kind == Kind::altered;
    }
};

/// Settings of the analyzer that computes the features.
struct FeaturePlan {
    std::shared_ptr<const BeatNetwork> beat_network;  ///< beat tracker's network; null: none
    CepstralMeanConfig cepstral_mean;                 ///< of the genre model's features
};

/// Computes the features of these samples (mono, in [-1, 1]) and appends them to `piece`.
/// Errors: a rate that is not supported.
[[nodiscard]] Expected<void> extract_features(std::span<const float> samples,
                                              SampleRate rate,
                                              const FeaturePlan& plan,
                                              PieceFeatures& piece);

/// Writes the features of pieces to a file, numbers as this machine stores them. Errors: as
/// write_file.
[[nodiscard]] Expected<void> save_pieces(std::span<const PieceFeatures> pieces,
                                         const std::filesystem::path& path);
/// Reads what save_pieces wrote. Errors: not such a file, another version, cut short, sizes that do
/// not fit together.
[[nodiscard]] Expected<std::vector<PieceFeatures>> load_pieces(const std::filesystem::path& path);

/// Binary form of a piece's features, for caches and shards on the same kind of machine.
void pack_piece(const PieceFeatures& piece, Packer& packer);
/// Reads what pack_piece wrote and checks it. Errors: cut short; numbers that are not finite or too
/// large; sizes that do not fit together; a window outside its piece; a name that no dance can
/// have.
[[nodiscard]] Expected<PieceFeatures> unpack_piece(Unpacker& unpacker);

}  // namespace raks::audio
