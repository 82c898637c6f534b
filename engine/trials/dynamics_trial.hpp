#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/trials/dance_trial.hpp"
#include "motion/evaluate/dynamics_measures.hpp"

/// Does the dance follow the music? Body speed over the sections of music whose form is known, and
/// what the dance makes of whole songs.
namespace raks::engine {

/// What the dancer knows of a song while it dances.
enum class Knowledge : std::uint8_t {
    live,   ///< what has sounded
    known,  ///< all of it: a file
};

/// A piece of music danced from its first sample to its last.
struct DancedMusic {
    std::vector<motion::Pose> poses;         ///< of the measured member, kTrialPosesPerSecond
    std::vector<motion::DancerStatus> hops;  ///< of the first member, by hop
    std::optional<double> danceable_from;    ///< seconds: the beat grid can be danced to
    std::optional<double> first_count;       ///< seconds: count 1 of the first figure
    std::optional<double> first_danced;      ///< seconds: the dancer begins
    /// Of a song that is known, from 8 s on: bars of parts that come again (Foresight::repeats).
    std::vector<motion::RepeatedBar> repeats;
};
/// Dances to mono samples. Errors: those of the analyzer and of the dancers. Threads: workers.
[[nodiscard]] Expected<DancedMusic> dance_to(std::span<const float> mono,
                                             SampleRate rate,
                                             const TrialCast& cast,
                                             Knowledge knowledge);

/// Body speed in a section over that in the whole band's first section from 6 s on.
struct MusicalityRatios {
    double full = 0.0;       ///< m/s: the speed that the others are compared with
    double breakdown = 0.0;  ///< from 1 s after its start on
    double silence = 0.0;    ///< from 0.5 s after its start on
    double bar_after = 0.0;  ///< the first bar of the drop
    double drop = 0.0;       ///< its first 8 s
    double end_to_2 = 0.0;   ///< 0 to 2 s after the music's end
    double end_to_5 = 0.0;   ///< 2 to 5 s
    double end_to_13 = 0.0;  ///< 5 to 13 s
};

/// What was measured of one dance that is told `knowledge` of its music.
struct DynamicsResult {
    MusicalityRatios ratios;           ///< on music of five sections: contrast_music()
    motion::DynamicsMeasures phrased;  ///< on song_music() from 8 s to its end
    motion::DynamicsMeasures steady;   ///< on music without a form, from 8 s on
    double follows_loudness = 0.0;     ///< motion::loudness_correlation on the drawn song
    /// Live: bars from when the beat can be danced to until the dancer begins. None: it never does.
    std::optional<double> bars_to_begin;
    /// Seconds of count 1 of the first figure after the nearest downbeat of the music.
    std::optional<double> first_count_off;
};

/// 20 s of the whole band, 12 s through a low-pass at 300 Hz and 12 dB quieter, 2 s of silence, 16
/// s of the band again (the drop), then 14 s of silence: each to the nearest beat, the drop on a
/// downbeat. In the dance's own style at its likely tempo.
[[nodiscard]] audio::MusicPlan contrast_music(const DanceInfo& dance, std::uint64_t seed);
/// A drawn song of 90 s in the same style and tempo, whose first beat comes after 2 s.
[[nodiscard]] audio::MusicPlan song_music(const DanceInfo& dance, std::uint64_t seed);

/// Measures a dance on contrast_music, song_music and 64 s without a form, all of this seed.
/// Errors: those of dance_to. Threads: workers. Real-time: no (some 10 s).
[[nodiscard]] Expected<DynamicsResult> run_dynamics_trial(const DanceInfo& dance,
                                                          const TrialCast& cast,
                                                          std::uint64_t seed,
                                                          Knowledge knowledge);

/// Loudness of mono samples at motion::kDynamicsRate: the level below 7.7 kHz of each sixtieth of a
/// second, dB with a floor at -80. Errors: those of the resampler.
[[nodiscard]] Expected<std::vector<double>> loudness_by_frame(std::span<const float> mono,
                                                              SampleRate rate);

/// How a dance follows music: its loudness, and the parts of it that come again.
struct MusicFollowing {
    double correlation = 0.0;       ///< motion::loudness_correlation
    double spread_db = 0.0;         ///< of the loudness averaged as there: 95th less 5th percentile
    motion::PartRepeats repeats{};  ///< of a song that is known
};
/// Dances to mono samples and measures it. Errors: those of dance_to.
[[nodiscard]] Expected<MusicFollowing> music_following(std::span<const float> mono,
                                                       SampleRate rate,
                                                       const TrialCast& cast,
                                                       Knowledge knowledge);

}  // namespace raks::engine
