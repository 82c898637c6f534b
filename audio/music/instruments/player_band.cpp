#include "audio/music/instruments/player_band.hpp"

namespace raks::audio {
namespace {

/// A player tuned up to `most_semitones` up or down.
BandPlayer draw_player(std::size_t soundfonts, double most_semitones, Dice& dice) {
    BandPlayer player;
    player.soundfont = static_cast<std::size_t>(dice.whole(0, static_cast<int>(soundfonts) - 1));
    player.semitones = dice.uniform(-most_semitones, most_semitones);
    // Most soundfonts leave the low-pass open, so moving its corner up would change nothing.
    player.brightness = dice.chance(0.5) ? -dice.uniform(0.0, 2.5) : 0.0;
    player.decay = dice.uniform(-1.0, 1.0);
    player.level = dice.uniform(-8.0, 4.0);
    return player;
}

}  // namespace

PlayerBand draw_band(std::size_t soundfonts, Dice& dice) {
    constexpr double kConcertPitch = 0.3;  // semitones that a band may be off it
    constexpr double kDrumTuning = 4.0;    // semitones
    PlayerBand band;
    const double pitch = dice.uniform(-kConcertPitch, kConcertPitch);
    // Instruments of a band are in tune with one another; drums need not be.
    for (BandPlayer& player : band.channels) {
        player = draw_player(soundfonts, 0.0, dice);
        player.semitones = pitch;
    }
    for (BandPlayer& drummer : band.drummers) {
        drummer = draw_player(soundfonts, kDrumTuning, dice);
        if (dice.chance(0.25)) {
            drummer.kit = dice.pick({0, 8, 16, 24, 25, 32, 40});  // of General MIDI
        }
    }
    // Each drum is dealt on its own, so that a kit mixes several soundfonts.
    for (std::size_t& drummer : band.drummer_of_key) {
        drummer =
            static_cast<std::size_t>(dice.whole(0, static_cast<int>(PlayerBand::kDrummers) - 1));
    }
    return band;
}

}  // namespace raks::audio
