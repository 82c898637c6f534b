#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "audio/beat/rival_pulses.hpp"
#include "audio/song/beat_path.hpp"
#include "audio/song/song_recording.hpp"

namespace raks::audio {

/// How well the beats of a song and their rivals explain the music around each beat.
/// Threads: any. Real-time: no.
class SongMargins {
 public:
    /// Both must outlive it. Without evidence of networks all margins are 0.
    SongMargins(const SongRecording& song, const std::vector<PathBeat>& path);

    /// Of the music from 5 s before to 5 s after a beat, as much of it as the tracker remembers.
    [[nodiscard]] PulseMargins around(std::size_t beat) const;
    /// Tempo at a beat of a path of at least two.
    [[nodiscard]] double bpm(std::size_t beat) const;

 private:
    static constexpr std::int64_t kAround = 500;  // hops
    const std::vector<PathBeat>& path_;
    std::vector<PulseFits> sums_;  // of all hops before
};

}  // namespace raks::audio
