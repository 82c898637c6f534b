#pragma once

#include <cstdint>
#include <vector>

#include "audio/music/generator/music_generator.hpp"

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
inline constexpr int kSoundCount = static_cast<int>(Sound::pad) + 1;

[[nodiscard]] constexpr bool is_pitched(Sound sound) noexcept { return sound >= Sound::bass; }

/// One note of a piece. Its attack starts exactly at `beat`.
struct Note {
    double beat = 0.0;  ///< since the first beat
    Sound sound = Sound::click_low;
    int pitch = 60;         ///< MIDI note number; pitched sounds only
    double beats = 0.0;     ///< length; pitched sounds only
    double velocity = 1.0;  ///< (0, 1]: amplitude, and brightness of brass
};

/// Writes all notes with 0 <= beat < `beats`, in any order. (One function a style, in its own
/// file.)
using Notes = std::vector<Note>;
[[nodiscard]] Notes write_clicks(double beats);
[[nodiscard]] Notes write_drums(double beats, std::uint64_t seed);
[[nodiscard]] Notes write_montuno(double beats, std::uint64_t seed);
[[nodiscard]] Notes write_maqsum(double beats, std::uint64_t seed);
[[nodiscard]] Notes write_four_on_the_floor(double beats, std::uint64_t seed);
[[nodiscard]] Notes write_backbeat(double beats, std::uint64_t seed);
[[nodiscard]] Notes write_boom_bap(double beats, std::uint64_t seed);
[[nodiscard]] Notes write_oom_pah_pah(double beats, std::uint64_t seed);

}  // namespace raks::audio
