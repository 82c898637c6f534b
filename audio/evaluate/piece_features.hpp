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
#include "base/time.hpp"

namespace raks::audio {

class BeatNetwork;

/// A genre as people read it: "unknown" for none of the dances.
[[nodiscard]] constexpr std::string_view shown_genre(std::string_view genre) noexcept {
    return genre.empty() ? "unknown" : genre;
}

/// Bar patterns of one window of a piece.
struct WindowFeatures {
    int segments = 1;   ///< its length: one of kGenreWindows
    int end_frame = 0;  ///< frames of the piece before its end
    std::array<float, BarPatterns::kFeatures> features{};
};

/// One piece as the analyzer hears it, silence left out: what genre models are learnt from.
struct PieceFeatures {
    std::string name;
    std::string group;  ///< artist; of written music: its style and soundfont
    std::string genre;  ///< name of a dance; empty: none of the dances
    enum class Kind : std::uint8_t {
        recorded,
        altered,  ///< a recording after some damage: to learn from and to fit fusions to
        written,
        written_held_out  ///< by a family of arrangements that training may leave out
    };
    Kind kind = Kind::recorded;
    std::vector<MfccVector> frames;
    std::vector<float> mel;               ///< of each frame NoiseFloor::kBands magnitudes, no hiss
    std::vector<WindowFeatures> windows;  ///< every second, of each length that was full

    [[nodiscard]] std::size_t hops() const noexcept {
        return mel.size() / static_cast<std::size_t>(BarPatterns::kMelBands);
    }
    [[nodiscard]] bool is_recorded() const noexcept {
        return kind == Kind::recorded || kind == Kind::altered;
    }
};

/// What the sound is heard with.
struct FeaturePlan {
    std::shared_ptr<const BeatNetwork> beat_network;
    CepstralMeanConfig cepstral_mean;
};

/// Adds frames and windows of these samples (mono) to `piece`.
/// Errors: a rate that is not supported.
[[nodiscard]] Expected<void> extract_features(std::span<const float> samples,
                                              SampleRate rate,
                                              const FeaturePlan& plan,
                                              PieceFeatures& piece);

/// Pieces kept between runs; numbers as this machine stores them.
/// Errors of reading: not such a file, cut short, sizes that do not fit together.
[[nodiscard]] Expected<void> save_pieces(std::span<const PieceFeatures> pieces,
                                         const std::filesystem::path& path);
[[nodiscard]] Expected<std::vector<PieceFeatures>> load_pieces(const std::filesystem::path& path);

}  // namespace raks::audio
