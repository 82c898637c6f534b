#pragma once

#include <span>
#include <vector>

#include "base/dice.hpp"

namespace raks::audio {

/// A camera or another recorder in a room where music plays: what its microphone gets, and its
/// clock. The music's own time is that of the room.
struct RoomRecorder {
    double seconds = 40.0;       ///< length of the recording, by its own clock
    double offset = 0.0;         ///< the music's time at its first sample; seconds, may be negative
    double drift_ppm = 0.0;      ///< music's time = offset + (1 + drift_ppm / 1e6) x its own
    double metres = 0.0;         ///< from the loudspeaker: sound takes 1 s for 343 m
    double reverberation = 0.5;  ///< seconds until it is 60 dB down; 0: no room
    double direct_to_reverberant_db = 0.0;  ///< direct sound against all of the reverberation
    double signal_to_noise_db = 10.0;       ///< white noise of its own
};

/// What the recorder has of mono music, at the same rate; where there is no music, its noise.
/// The room's reflections are drawn (add_room of sound_damage.hpp).
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<float> record_in_room(int rate,
                                                std::span<const float> music,
                                                const RoomRecorder& recorder,
                                                Dice& dice);

}  // namespace raks::audio
