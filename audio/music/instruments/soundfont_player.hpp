#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "audio/music/instruments/player_band.hpp"
#include "audio/music/score/performance.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// The room that a performance is played in.
struct PlayerRoom {
    double size = 0.0;   ///< 0 dry to 1
    double level = 0.0;  ///< of the reverb, 0 to 1
};

/// Plays performances with a soundfont (FluidSynth). Threads: one each.
class SoundfontPlayer {
 public:
    static constexpr int kRate = kPerformanceRate;

    /// Errors: a soundfont cannot be loaded.
    [[nodiscard]] static Expected<SoundfontPlayer> open(
        std::span<const std::filesystem::path> soundfonts);

    /// Mono samples at kRate, peak 0.7, its delay of 2.5 ms taken off. All of it by the first
    /// soundfont.
    [[nodiscard]] std::vector<float> play(const Performance& performance, const PlayerRoom& room);
    /// The same by a band, whose players have soundfonts and sounds of their own.
    [[nodiscard]] std::vector<float> play(const Performance& performance,
                                          const PlayerRoom& room,
                                          const PlayerBand& band);

    SoundfontPlayer(SoundfontPlayer&&) noexcept;
    SoundfontPlayer& operator=(SoundfontPlayer&&) noexcept;
    ~SoundfontPlayer();

 private:
    struct Synth;
    explicit SoundfontPlayer(std::unique_ptr<Synth> synth);
    std::unique_ptr<Synth> synth_;
};

/// Which of `soundfonts` (not empty) play a piece: of several mostly all, as a band, else one.
[[nodiscard]] std::vector<std::filesystem::path> draw_soundfonts(
    std::span<const std::filesystem::path> soundfonts, Dice& dice);

/// Played by a band drawn of several soundfonts, or by the one. Each piece has a new player: one
/// that has played before does not play the same samples again, and loading it costs less than a
/// second of music. Errors: a soundfont cannot be loaded.
[[nodiscard]] Expected<std::vector<float>> play_with(
    std::span<const std::filesystem::path> soundfonts,
    const Performance& performance,
    const PlayerRoom& room,
    Dice& dice);

}  // namespace raks::audio
