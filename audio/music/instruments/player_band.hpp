#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/dice.hpp"

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

/// Who plays a performance: a player for each channel, and several at the drums, so that three
/// soundfonts make many kits and bands rather than three. What is learnt from them has to hold for
/// a fourth.
struct PlayerBand {
    static constexpr std::size_t kDrummers = 8;
    static constexpr std::size_t kKeys = 128;

    std::array<BandPlayer, 16> channels;
    std::array<BandPlayer, kDrummers> drummers;
    std::array<std::size_t, kKeys> drummer_of_key{};

    friend bool operator==(const PlayerBand&, const PlayerBand&) = default;
};

/// Each player's soundfont is drawn of `soundfonts`, its tuning, brightness, decay and level about
/// what the soundfont has.
[[nodiscard]] PlayerBand draw_band(std::size_t soundfonts, Dice& dice);

}  // namespace raks::audio
