#pragma once

#include <cstdint>
#include <vector>

#include "audio/music/generator/notes.hpp"

namespace raks::audio {

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
