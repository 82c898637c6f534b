#include "audio/io/hearing.hpp"

#include "audio/io/downmix.hpp"
#include "base/assert.hpp"

namespace raks::audio {

void hear_mono(std::span<const float> interleaved,
               std::size_t channels,
               const Hearing& hearing,
               std::span<float> mono) noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(channels >= 1 && mono.size() >= interleaved.size() / channels);
    const std::size_t frames = interleaved.size() / channels;
    if (hearing.is_from_side && channels == 2) {
        for (std::size_t i = 0; i < frames; ++i) {
            mono[i] = 0.5F * (interleaved[2 * i] - interleaved[2 * i + 1]);
        }
    } else {
        downmix_to_mono(interleaved, channels, mono);
    }
    if (hearing.offset != 0.0F || hearing.gain != 1.0F) {
        for (float& sample : mono.first(frames)) {
            sample = (sample - hearing.offset) * hearing.gain;
        }
    }
}

void hear_stereo(std::span<const float> interleaved,
                 std::size_t channels,
                 const Hearing& hearing,
                 std::span<float> stereo) noexcept {
    downmix_to_stereo(interleaved, channels, stereo);
    if (hearing.gain < 1.0F) {
        for (float& sample : stereo.first(2 * (interleaved.size() / channels))) {
            sample *= hearing.gain;
        }
    }
}

}  // namespace raks::audio
