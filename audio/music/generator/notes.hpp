#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "audio/music/generator/music_generator.hpp"

/// Notes and scores of the generated music, and how its notes are synthesized.
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

/// Adds one note for each letter of `pattern`, from beat `start` on, `step` beats apart: 'X' loud,
/// 'x' medium, 'o' soft, anything else a rest. `level`: factor of the velocities.
///
///     strike(score, Sound::clave, "x..x..x...x.x...", bar_start, 0.5);
inline void strike(Notes& score,
                   Sound sound,
                   std::string_view pattern,
                   double start,
                   double step,
                   double level = 1.0) {
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const char mark = pattern[i];
        const double velocity =
            mark == 'X' ? 1.0 : (mark == 'x' ? 0.72 : (mark == 'o' ? 0.42 : 0.0));
        if (velocity > 0.0) {
            score.push_back({.beat = start + step * static_cast<double>(i),
                             .sound = sound,
                             .velocity = velocity * level});
        }
    }
}

/// Writes bar after bar by write_bar(score, bar), bars counted from 0, and drops notes beyond the
/// end.
template <typename WriteBar>
[[nodiscard]] Notes write_bars(double beats, int beats_per_bar, const WriteBar& write_bar) {
    Notes score;
    for (int bar = 0; bar * beats_per_bar < beats; ++bar) {
        write_bar(score, bar);
    }
    std::erase_if(score, [beats](const Note& note) { return note.beat >= beats; });
    return score;
}

/// Parameters of one sound. Equal requests give equal samples.
struct SoundRequest {
    Sound sound = Sound::click_low;  ///< what to make
    double hertz = 440.0;            ///< pitched sounds: fundamental
    double seconds = 0.2;            ///< pitched sounds: until the key is released
    double brightness = 1.0;         ///< (0, 1]
    int variant = 0;                 ///< strokes of a drum differ a little
    double rate = 48'000.0;          ///< sample rate, hertz
};

/// One stroke or note, mono, peak 1; begins with its attack and ends faded out.
[[nodiscard]] std::vector<float> synthesize(const SoundRequest& request);

/// The drums of synthesize(), not scaled to a peak.
[[nodiscard]] std::vector<float> synthesize_drum(const SoundRequest& request);
/// The pitched sounds of synthesize(), not scaled to a peak.
[[nodiscard]] std::vector<float> synthesize_tone(const SoundRequest& request);

}  // namespace raks::audio
