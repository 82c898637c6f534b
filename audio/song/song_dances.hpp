#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "audio/genre/genre_recognizer.hpp"
#include "audio/song/song_beats.hpp"
#include "audio/song/song_recording.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

/// A part of a song, or a song of a medley, that is music for one class of the genre model.
struct SongSection {
    std::size_t first_hop = 0;            ///< the section goes on to the next one, or to the end
    std::uint8_t genre_class = 0;         ///< of the model
    bool is_told = false;                 ///< by the tags, and not heard
    GenreLogProbabilities log_chances{};  ///< of all of the section, by class
};

/// What the dances of a song are told by.
struct SongHeard {
    std::span<const MusicState> states;  ///< of the whole song, with the grid as known ahead
    std::span<const SongBeat> beats;     ///< likewise
    std::span<const SongRecording::Moment> moments;  ///< what the own parts said
    std::span<const SongJudgement::Patch> patches;   ///< what the tagger said
};

/// The sections of a song by the evidence of all of it. Where the dance changes is found by the
/// most likely path in which each section lasts 15 s at least, and another class costs as much as
/// some 10 s of clear evidence; less after a silence in which a song can end. A section begins with
/// the sound after a silence, else where metre or tempo change, else on a bar line. Each is then
/// judged by itself, as a stream judges a song that it has heard to its end, and from its first hop
/// on. `genres`: who said it; `prior`: what the tags say, GenreSettings::prior. One section at
/// least, unless there are no states. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SongSection> find_sections(const SongHeard& heard,
                                                     const GenreRecognizer& genres,
                                                     const GenreLogProbabilities& prior);

}  // namespace raks::audio
