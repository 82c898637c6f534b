#pragma once

#include <cstdint>
#include <vector>

#include "audio/music/generator/music_generator.hpp"

/// Notes and scores of the generated music.
namespace raks::audio {

/// Every sound that the band can make. The second group has a pitch and a length.
enum class Sound : std::uint8_t {
    click_high,
    click_low,
    kick,
    club_kick,
    snare,
    clap,
    closed_hat,
    open_hat,
    crash,
    clave,
    cowbell,
    cowbell_mouth,
    conga_open,
    conga_low,
    conga_slap,
    conga_heel,
    guiro_long,
    guiro_short,
    maracas,
    timbale_high,
    timbale_low,
    cascara,
    darbuka_dum,
    darbuka_tek,
    darbuka_ka,
    riq,
    // pitched
    bass,
    synth_bass,
    piano,
    brass,
    oud,
    stab,
    guitar,
    pad,
};
/// How many sounds there are.
inline constexpr int kSoundCount = static_cast<int>(Sound::pad) + 1;

/// Whether a sound has a pitch and a length.
[[nodiscard]] constexpr bool is_pitched(Sound sound) noexcept { return sound >= Sound::bass; }

/// One note of a piece. Its attack starts exactly at `beat`.
struct Note {
    double beat = 0.0;               ///< since the first beat
    Sound sound = Sound::click_low;  ///< who plays
    int pitch = 60;                  ///< MIDI note number; pitched sounds only
    double beats = 0.0;              ///< length; pitched sounds only
    double velocity = 1.0;           ///< (0, 1]: amplitude, and brightness of brass
};

/// A score: notes in any order. Each of the functions below writes all notes of a style with 0 <=
/// beat < `beats`; the same seed gives the same score.
using Notes = std::vector<Note>;
/// A click on every beat, the downbeat higher.
[[nodiscard]] Notes write_clicks(double beats);
/// A rock kit alone.
[[nodiscard]] Notes write_drums(double beats, std::uint64_t seed);
/// Salsa for a small band.
[[nodiscard]] Notes write_montuno(double beats, std::uint64_t seed);
/// Darbuka, riq, oud and bass.
[[nodiscard]] Notes write_maqsum(double beats, std::uint64_t seed);
/// House.
[[nodiscard]] Notes write_four_on_the_floor(double beats, std::uint64_t seed);
/// Rock.
[[nodiscard]] Notes write_backbeat(double beats, std::uint64_t seed);
/// Hip-hop.
[[nodiscard]] Notes write_boom_bap(double beats, std::uint64_t seed);
/// Waltz, in bars of three.
[[nodiscard]] Notes write_oom_pah_pah(double beats, std::uint64_t seed);

}  // namespace raks::audio
