#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "audio/music/damage/room_recorder.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/sync/sync_track.hpp"
#include "base/dice.hpp"

/// Recordings of music whose clocks are known.
namespace raks::test {

inline constexpr int kRecordingRate = audio::SyncTrack::kRate;  // hertz

/// Salsa of our own: `seconds` of mono.
inline std::vector<float> salsa(double seconds, std::uint64_t seed) {
    audio::MusicPlan plan;
    plan.tempo = {{0.0, 184.0}};
    plan.seconds = seconds;
    plan.rate = SampleRate(kRecordingRate);
    plan.channels = 1;
    plan.seed = seed;
    return audio::generate(plan)->samples;
}

/// White noise: the easiest sound to find, and quickly made.
inline std::vector<float> white_noise(double seconds, std::uint64_t seed) {
    Dice dice(seed, 0);
    std::vector<float> samples(static_cast<std::size_t>(seconds * kRecordingRate));
    for (float& sample : samples) {
        sample = static_cast<float>(dice.uniform(-0.5, 0.5));
    }
    return samples;
}

/// What a recorder without room and nearly without noise has of music.
inline audio::RoomRecorder dry_recorder(double seconds, double offset, double drift_ppm) {
    audio::RoomRecorder recorder;
    recorder.seconds = seconds;
    recorder.offset = offset;
    recorder.drift_ppm = drift_ppm;
    recorder.reverberation = 0.0;
    recorder.signal_to_noise_db = 30.0;
    return recorder;
}

/// A recording made ready to be aligned. `number`: of its noise and room.
inline audio::SyncTrack recording(const std::vector<float>& music,
                                  const audio::RoomRecorder& recorder,
                                  const std::string& name,
                                  std::uint64_t number) {
    Dice dice(41, number);
    const auto samples = audio::record_in_room(kRecordingRate, music, recorder, dice);
    return *audio::SyncTrack::prepare(samples, SampleRate(kRecordingRate), name);
}

}  // namespace raks::test
