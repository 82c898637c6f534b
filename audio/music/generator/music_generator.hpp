#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "audio/music/generator/song_form.hpp"
#include "audio/music/generator/tempo_curve.hpp"
#include "base/beats.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Styles of the generator. All are in bars of four beats, but for the last.
enum class Style : std::uint8_t {
    clicks,             ///< one dry click on every beat, the downbeat higher; nothing else
    drums,              ///< rock kit: bass drum 1 and 3, snare 2 and 4, hi-hat in eighths
    montuno,            ///< son clave, tumbao bass, montuno piano, congas, brass; 150-220 BPM
    maqsum,             ///< darbuka D T - T D - T -, riq, oud in hijaz; best at 90-140 BPM
    four_on_the_floor,  ///< and off-beat hats and bass, stabs, pad; best at 115-130 BPM
    backbeat,           ///< straight eighths, snare 2 and 4, power chords; best at 110-150 BPM
    boom_bap,           ///< swung sixteenths, snare and clap 2 and 4, deep bass; 75-105 BPM
    oom_pah_pah         ///< bars of three: bass on 1, chords on 2 and 3, a melody; 80-190 BPM
};
/// Bar length of a style.
[[nodiscard]] constexpr int beats_per_bar(Style style) noexcept {
    return style == Style::oom_pah_pah ? 3 : 4;
}

/// The tempo at which music of a style is mostly played.
[[nodiscard]] constexpr Bpm usual_tempo(Style style) noexcept {
    switch (style) {
        case Style::montuno:
            return Bpm(184.0);
        case Style::maqsum:
            return Bpm(110.0);
        case Style::four_on_the_floor:
            return Bpm(124.0);
        case Style::backbeat:
            return Bpm(130.0);
        case Style::boom_bap:
            return Bpm(92.0);
        case Style::oom_pah_pah:
            return Bpm(140.0);
        case Style::clicks:
        case Style::drums:
            break;
    }
    return Bpm(120.0);
}

/// Names in the order of Style: "clicks", "drums", "four-on-the-floor" and so on.
[[nodiscard]] std::span<const std::string_view> style_names() noexcept;
/// Errors: any other name (the nearest is named).
[[nodiscard]] Expected<Style> style_from_name(std::string_view name);
/// The style's name.
[[nodiscard]] std::string_view name_of(Style style) noexcept;

/// A stretch of digital silence, [from, to) in seconds since the start of the piece.
struct Silence {
    double from_seconds = 0.0;  ///< start
    double to_seconds = 0.0;    ///< end, not included
};

/// What to play. generate() checks it and names every fault.
struct MusicPlan {
    Style style = Style::montuno;  ///< which band plays
    /// Tempo over time, see TempoCurve: piecewise linear in seconds, constant before the first
    /// and after the last point, two points at the same second are a jump. 20 to 400 BPM.
    std::vector<TempoPoint> tempo{{0.0, 180.0}};
    double seconds = 30.0;            ///< length of the piece, (0, 3600]
    SampleRate rate{48'000};          ///< a supported one
    int channels = 2;                 ///< 1 (the average of the two) or 2
    std::uint64_t seed = 1;           ///< key, chords, clave side, melody, small accents
    double first_beat_seconds = 0.0;  ///< time of beat 0, a downbeat; >= 0
    std::vector<Silence> silences{};  ///< ascending, not overlapping; beats continue inside
    /// Sections from beat 0 on, and silence after them; those beyond the piece's end are left out.
    /// Empty: the style plays on to the end. Not together with `silences`.
    std::vector<FormSection> form{};
};

/// A beat that the piece was made from: the reference for beat tracking.
struct ReferenceBeat {
    StreamTime time{};       ///< to the nanosecond; its sounds start at the nearest sample
    int bar_position = 1;    ///< 1..beats_per_bar(style)
    bool is_audible = true;  ///< false inside a silence, or where the form has no sound
};

/// A bar as it was played.
struct PlayedBar {
    StreamTime time{};                     ///< its first beat
    SectionKind kind = SectionKind::full;  ///< of the section that plays there; stop after the form
    std::vector<std::uint32_t> notes;      ///< sound, pitch and place of each, ascending
};
/// How unlike two bars are, as audio/song/song_repeats.hpp has it: by the share of notes that both
/// have; at most 1 where that is three quarters or more. Infinite where the band plays otherwise
/// (but for a drop and full, which are one), or a bar has no notes.
[[nodiscard]] float distance_of(const PlayedBar& a, const PlayedBar& b);

/// What a piece was made from: the reference for analysis. All ascending.
struct MusicTruth {
    std::vector<ReferenceBeat> beats;     ///< all that lie inside the piece
    std::vector<PlayedSection> sections;  ///< of the form; without one the sound and its silences
    std::vector<MusicEvent> events;       ///< events_of(sections)
    std::vector<StreamTime> phrases;      ///< every eighth bar of a section that sounds
    std::vector<PlayedBar> bars;          ///< all that begin inside the piece
};

/// A finished piece and what it was made from.
struct GeneratedMusic : MusicTruth {
    SampleRate rate{48'000};     ///< of the plan
    int channels = 2;            ///< 1 or 2
    std::vector<float> samples;  ///< interleaved, [-1, 1], no NaN

    /// Length of the piece.
    [[nodiscard]] std::int64_t frames() const noexcept {
        return static_cast<std::int64_t>(samples.size()) / channels;
    }
    /// The average of the channels, frames() samples.
    [[nodiscard]] std::vector<float> mono() const;
};

/// Renders `plan` with synthesized sounds. The same plan gives the same bits.
///
///     const auto music = generate({.style = Style::montuno, .tempo = {{0, 90}, {20, 140}}});
///
/// Errors: every fault of the plan, in one line. Cost: about 1/300 of the piece's length.
/// Threads: any, no shared state. Real-time: no.
[[nodiscard]] Expected<GeneratedMusic> generate(const MusicPlan& plan);

/// Takes the next samples of a piece, interleaved; returns false to end it.
using MusicSink = std::function<bool(std::span<const float> samples)>;
/// The same piece, handed to `sink` block by block: for long ones, which would fill the memory.
/// Returns what it was made from. Errors: those of generate(); `sink` ended it.
[[nodiscard]] Expected<MusicTruth> generate(const MusicPlan& plan, const MusicSink& sink);
/// A typical song for a plan's style, tempo, length and seed (draw_form()), to be its form.
[[nodiscard]] std::vector<FormSection> song_form_of(const MusicPlan& plan);
/// How many frames the piece of a plan has.
[[nodiscard]] std::int64_t frames_of(const MusicPlan& plan) noexcept;

/// The piece that `raks` dances to when no file is given: 60 s of a montuno at 184 BPM.
[[nodiscard]] MusicPlan demo_plan();

}  // namespace raks::audio
