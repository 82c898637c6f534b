#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "base/beat_grid.hpp"
#include "base/dance_list.hpp"
#include "base/time.hpp"

namespace raks {

/// Most genres of one genre model.
inline constexpr std::size_t kMostGenres = 16;
/// By class of the genre model: its genres, then none of them. Natural logarithms; their
/// exponentials sum to 1.
using GenreLogProbabilities = std::array<float, kMostGenres + 1>;

/// A beat as announced; it is never revised.
struct BeatEvent {
    StreamTime time{};  ///< when it sounds in the input, corrected for the delays of the analysis
    int bar_position = 0;         ///< 1..beats_per_bar; 0: the bar is not known
    float confidence = 0.0F;      ///< [0, 1]
    float bar_confidence = 0.0F;  ///< [0, 1], of bar_position
    friend bool operator==(const BeatEvent&, const BeatEvent&) = default;
};

/// How much the music gives, from its loudness, low band, density of onsets and brightness. Each
/// [0, 1] against the song's own range so far: 0 its calmest, 0.5 as usual, 1 its fullest.
struct MusicEnergy {
    float now = 0.5F;     ///< of about half a second; falls to 0 in silence
    float lately = 0.5F;  ///< of the last 4 s; in a song that is known, of the 4 s around the hop
    float longer = 0.5F;  ///< of the last 30 s
    friend bool operator==(const MusicEnergy&, const MusicEnergy&) = default;
};

/// What the music is doing at a hop.
enum class MusicPart : std::uint8_t {
    stopped,    ///< nothing sounds: before the music, in a pause, or after its end
    playing,    ///< the whole band, or all that this song has
    breakdown,  ///< the rhythm section is gone; something goes on
    build_up,   ///< it rises towards a drop
};

/// The words for MusicPart, in its order.
inline constexpr std::array<std::string_view, 4> kMusicPartNames = {
    "stopped", "playing", "breakdown", "build-up"};
static_assert(kMusicPartNames.size() == static_cast<std::size_t>(MusicPart::build_up) + 1);

/// The word for a part, the same in all documents, reports and pictures.
[[nodiscard]] constexpr std::string_view music_part_name(MusicPart part) noexcept {
    return kMusicPartNames[static_cast<std::size_t>(part)];
}

/// A change in what the music is doing.
struct MusicEvent {
    /// What happens.
    enum class Kind : std::uint8_t {
        none,       ///< nothing: no event
        stop,       ///< the sound is gone or cut
        entry,      ///< music begins, or goes on after a stop
        breakdown,  ///< the rhythm section leaves
        build_up,   ///< it begins to rise
        drop,       ///< everything comes in after a breakdown or a build-up
        end,        ///< the song is over
    };
    Kind kind = Kind::none;  ///< what happens
    StreamTime time{};       ///< when it sounds in the input
    friend bool operator==(const MusicEvent&, const MusicEvent&) = default;
};

/// The words for MusicEvent::Kind, in its order.
inline constexpr std::array<std::string_view, 7> kMusicEventNames = {
    "none", "stop", "entry", "breakdown", "build-up", "drop", "end"};
static_assert(kMusicEventNames.size() == static_cast<std::size_t>(MusicEvent::Kind::end) + 1);

/// The word for a kind of event, the same in all documents, reports and pictures.
[[nodiscard]] constexpr std::string_view music_event_name(MusicEvent::Kind kind) noexcept {
    return kMusicEventNames[static_cast<std::size_t>(kind)];
}

/// The tempo that the music may have in place of the one that is followed.
struct RivalTempo {
    double bpm = 0.0;          ///< 0: there is none
    float probability = 0.0F;  ///< [0, 1], beside the grid's confidence
    friend bool operator==(const RivalTempo&, const RivalTempo&) = default;
};

/// A strong onset.
struct MusicAccent {
    /// Where in the spectrum it is strongest.
    enum class Band : std::uint8_t {
        low,     ///< below 200 Hz: bass drum, bass
        middle,  ///< 200 Hz to 4 kHz: snare, chords, voices
        high,    ///< above 4 kHz: cymbals, claps
    };
    StreamTime time{};         ///< when it sounds in the input
    float strength = 0.0F;     ///< (0, 1] against the strongest of the last half minute
    Band band = Band::middle;  ///< where it is strongest
    bool is_on_beat = false;   ///< within 70 ms of a beat
    friend bool operator==(const MusicAccent&, const MusicAccent&) = default;
};

/// The words for MusicAccent::Band, in its order.
inline constexpr std::array<std::string_view, 3> kMusicBandNames = {"low", "middle", "high"};
static_assert(kMusicBandNames.size() == static_cast<std::size_t>(MusicAccent::Band::high) + 1);

/// The word for a band, the same in all documents, reports and pictures.
[[nodiscard]] constexpr std::string_view music_band_name(MusicAccent::Band band) noexcept {
    return kMusicBandNames[static_cast<std::size_t>(band)];
}

/// What sounds at a hop, by pitch, as lights and scopes show it. Against the loudest of the last
/// seconds, so that soft music fills it as loud music does.
struct MusicSpectrum {
    static constexpr std::size_t kBands = 16;  ///< even to the ear, 30 Hz to 15.5 kHz
    std::array<std::uint8_t, kBands> bands{};  ///< low to high; 0: 36 dB below, or silence
    float strongest_hz = 0.0F;                 ///< of the strongest band; 0: silence
    friend bool operator==(const MusicSpectrum&, const MusicSpectrum&) = default;
};

/// What is known beyond a hop where the whole song was analysed before it sounds.
struct Foresight {
    bool is_known = false;  ///< false: the rest means nothing, only the past is known
    StreamTime begins{};    ///< the first downbeat that can be danced to
    StreamTime ends{};      ///< the last beat that can
    /// [0, 1]: loudness of the next two bars or so; 0.5: as in the whole song
    float energy = 0.5F;
    /// The events that come next, the nearer one first; kind none: no more.
    std::array<MusicEvent, 2> events{};
    int bar = -1;  ///< number of the bar that sounds, from the first one at `begins`; -1: before it
    /// Of this bar and of the next three: the number of the earliest bar that it repeats, as a part
    /// of the song that comes again; -1: it is new.
    std::array<std::int16_t, 4> repeats{-1, -1, -1, -1};
    friend bool operator==(const Foresight&, const Foresight&) = default;
};

/// What the analyzer knows at one hop (10 ms): the only data that passes from audio to motion.
/// States come in order, one for every hop, without gaps.
struct MusicState {
    HopIndex hop = 0;   ///< sequence number; this state is about time_of_hop(hop)
    StreamTime time{};  ///< == time_of_hop(hop)
    /// End of the audio used so far (>= time); shows in plots that no future audio was used.
    StreamTime audio_end{};
    BeatGrid grid;     ///< tempo, beats and bars from here on
    RivalTempo rival;  ///< the likeliest other tempo, such as an octave or three for two
    /// Into how many parts the music divides the beats: 2 or 3.
    int beat_parts = 2;
    bool is_tempo_held = false;  ///< by a person: the beats go on, whatever is heard

    bool has_beat = false;       ///< `beat` was announced since the last hop
    BeatEvent beat;              ///< valid while has_beat
    bool has_predicted = false;  ///< `predicted` was committed: a beat about 100 ms ahead
    StreamTime predicted{};      ///< its time; valid while has_predicted

    GenreLogProbabilities genre_log_probability{};  ///< over the model's classes
    std::uint8_t genre_class = 0;                   ///< the decided class, with hysteresis
    /// The dance of genre_class in the program's list; none: no dance, or unknown.
    DanceId genre = DanceId::none;
    /// What the file says of itself decided on genre_class; heard alone it would be another.
    bool is_genre_told = false;
    /// A tagger's three strongest words for the music so far, of a list that lives as long as the
    /// program; empty where there is no tagger or it has said nothing.
    std::array<std::string_view, 3> tags{};

    float loudness_lufs = -120.0F;  ///< momentary (400 ms, EBU R 128), >= -120
    float level_dbfs = -120.0F;     ///< rms of this hop, >= -120
    float onset_strength = 0.0F;    ///< [0, inf), all bands; 0 in silence
    bool is_silent = true;          ///< no sound to analyse
    bool is_discontinuity = false;  ///< samples were lost before this hop; grid was re-anchored

    MusicSpectrum spectrum;               ///< what sounds
    MusicEnergy energy;                   ///< how much the music gives
    MusicPart part = MusicPart::stopped;  ///< what it is doing
    MusicEvent event;    ///< that became known at this hop; kind none: there was none
    MusicAccent accent;  ///< that became known at this hop; strength 0: there was none

    Foresight ahead;  ///< of a song that is known before it sounds

    /// The same music, later by this: all times move, the hop's number stays. A field that is a
    /// time has its line here.
    constexpr void move_by(Nanos shift) noexcept {
        time += shift;
        audio_end += shift;
        grid.anchor_time += shift;
        beat.time += shift;
        predicted += shift;
        event.time += shift;
        accent.time += shift;
        ahead.begins += shift;
        ahead.ends += shift;
        for (MusicEvent& coming : ahead.events) {
            coming.time += shift;
        }
    }
    friend bool operator==(const MusicState&, const MusicState&) = default;
};
static_assert(std::is_trivially_copyable_v<MusicState>);

}  // namespace raks
