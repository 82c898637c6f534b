#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "audio/music/score/score.hpp"
#include "base/dice.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// One player of a band: whose instrument it is, and how it sounds.
struct BandPlayer {
    std::size_t soundfont = 0;  ///< index into those that were opened
    double semitones = 0.0;     ///< tuned up
    double brightness = 0.0;    ///< octaves that its low-pass is moved
    double decay = 0.0;         ///< octaves that it sounds longer
    double level = 0.0;         ///< dB
    std::optional<int> kit;     ///< of a drummer: in place of the score's

    friend bool operator==(const BandPlayer&, const BandPlayer&) = default;
};

/// Who plays a performance: a player for each channel, and several at the drums, so that a few
/// soundfonts make many kits and bands. A model trained on them has to hold for soundfonts that it
/// was not trained on.
struct PlayerBand {
    /// Players that the drums are dealt to.
    static constexpr std::size_t kDrummers = 8;
    /// MIDI keys.
    static constexpr std::size_t kKeys = 128;

    /// By MIDI channel; the drum channel's entry is not used.
    std::array<BandPlayer, 16> channels;
    /// Each with a soundfont and kit of its own.
    std::array<BandPlayer, kDrummers> drummers;
    /// Index into `drummers` for each drum.
    std::array<std::size_t, kKeys> drummer_of_key{};

    friend bool operator==(const PlayerBand&, const PlayerBand&) = default;
};

/// Draws a band: each player's soundfont out of `soundfonts` (> 0), and its tuning, brightness,
/// decay and level around the soundfont's own.
[[nodiscard]] PlayerBand draw_band(std::size_t soundfonts, Dice& dice);

/// The room that a performance is played in.
struct PlayerRoom {
    double size = 0.0;   ///< 0 dry to 1
    double level = 0.0;  ///< of the reverb, 0 to 1
};

/// Draws which of `soundfonts` (not empty) play a piece: mostly all of them, as a band, else one.
[[nodiscard]] std::vector<std::filesystem::path> draw_soundfonts(
    std::span<const std::filesystem::path> soundfonts, Dice& dice);

/// Mono samples of `performance` at kPerformanceRate, performance.seconds long, peak 0.7, by a band
/// drawn of several soundfonts, or by the only one. The program raks-soundfont plays them with
/// FluidSynth in a cage: a process for each piece, since one that has played before does not give
/// the same samples again, and loading costs less than a second of music. Errors: a soundfont
/// cannot be loaded; the program is not there, broke off, hung or answered nonsense.
[[nodiscard]] Expected<std::vector<float>> play_with(
    std::span<const std::filesystem::path> soundfonts,
    const Performance& performance,
    const PlayerRoom& room,
    Dice& dice);

}  // namespace raks::audio
