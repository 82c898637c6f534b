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

/// Plays performances with soundfonts (FluidSynth). Threads: one each. Real-time: no.
class SoundfontPlayer {
 public:
    /// Samples a second of what it plays.
    static constexpr int kRate = kPerformanceRate;

    /// Errors: a soundfont cannot be loaded.
    [[nodiscard]] static Expected<SoundfontPlayer> open(
        std::span<const std::filesystem::path> soundfonts);

    /// Mono samples at kRate, performance.seconds long, peak 0.7; the synthesizer's delay of 2.5 ms
    /// is taken off. The first soundfont plays everything.
    [[nodiscard]] std::vector<float> play(const Performance& performance, const PlayerRoom& room);
    /// The same, played by a band whose players have soundfonts and sounds of their own.
    [[nodiscard]] std::vector<float> play(const Performance& performance,
                                          const PlayerRoom& room,
                                          const PlayerBand& band);

    /// The source may only be destroyed or assigned to.
    SoundfontPlayer(SoundfontPlayer&&) noexcept;
    /// As the constructor.
    SoundfontPlayer& operator=(SoundfontPlayer&&) noexcept;
    /// Frees the soundfonts.
    ~SoundfontPlayer();

 private:
    struct Synth;
    explicit SoundfontPlayer(std::unique_ptr<Synth> synth);
    std::unique_ptr<Synth> synth_;
};

/// Draws which of `soundfonts` (not empty) play a piece: mostly all of them, as a band, else one.
[[nodiscard]] std::vector<std::filesystem::path> draw_soundfonts(
    std::span<const std::filesystem::path> soundfonts, Dice& dice);

/// Samples of `performance` as in SoundfontPlayer::play, by a band drawn of several soundfonts, or
/// by the only one. Each piece has a new player: one that has played before does not give the same
/// samples again, and loading costs less than a second of music. Errors: a soundfont cannot be
/// loaded.
[[nodiscard]] Expected<std::vector<float>> play_with(
    std::span<const std::filesystem::path> soundfonts,
    const Performance& performance,
    const PlayerRoom& room,
    Dice& dice);

}  // namespace raks::audio
