#pragma once

#include <memory>
#include <vector>

#include "audio/beat/network/pulse_network.hpp"
#include "audio/song/beat_path.hpp"
#include "audio/song/song_recording.hpp"

namespace raks::audio {

/// Where the network for the metre says, over the beats around, that another pulse is the beat, the
/// beats become that pulse's. Returns for each beat the probability that it is the right pulse; 0.5
/// where nothing is known. `network`: null: nothing is changed.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<float> correct_pulse(const SongRecording& song,
                                               const std::shared_ptr<const PulseNetwork>& network,
                                               std::vector<PathBeat>& beats);

}  // namespace raks::audio
