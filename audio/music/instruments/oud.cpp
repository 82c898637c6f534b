#include "audio/music/instruments/oud.hpp"

#include <algorithm>
#include <cmath>

#include "audio/music/generator/sounds.hpp"

namespace raks::audio {

std::vector<float> play_oud(std::span<const OudNote> notes, int rate, std::size_t samples) {
    std::vector<float> sum(samples);
    for (const OudNote& note : notes) {
        const auto begin = static_cast<std::size_t>(std::max(0.0, note.time) * rate);
        if (begin >= samples) {
            continue;
        }
        // A hard pluck is brighter as well as louder.
        const std::vector<float> pluck = synthesize_tone({.sound = Sound::oud,
                                                          .hertz = note.hertz,
                                                          .seconds = std::max(0.1, note.length),
                                                          .brightness = 0.4 + 0.6 * note.strength,
                                                          .rate = static_cast<double>(rate)});
        const std::size_t count = std::min(pluck.size(), samples - begin);
        for (std::size_t i = 0; i < count; ++i) {
            sum[begin + i] += static_cast<float>(note.strength) * pluck[i];
        }
    }
    // Not 0, so that silence is not divided by zero.
    float peak = 1e-6F;
    for (const float sample : sum) {
        peak = std::max(peak, std::abs(sample));
    }
    for (float& sample : sum) {
        sample /= peak;
    }
    return sum;
}

}  // namespace raks::audio
