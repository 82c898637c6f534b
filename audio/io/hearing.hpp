#pragma once

#include <cstddef>
#include <span>

#include "base/realtime.hpp"

namespace raks::audio {

/// How a file's sound is brought before the analyzer, which hears one channel of ordinary level.
/// For nearly all files nothing is changed. Decided from the file alone, before it is played.
struct Hearing {
    /// One side is the other turned upside down, as by a wrongly wired cable: their mean is silent,
    /// and half of their difference is heard.
    bool is_from_side = false;
    float offset = 0.0F;  ///< subtracted from the mixed samples: a level that is not sound
    float gain = 1.0F;    ///< > 0, applied after that

    /// Is nothing changed?
    [[nodiscard]] bool is_plain() const noexcept {
        return !is_from_side && offset == 0.0F && gain == 1.0F;
    }
};

/// What is left to be done for the analyzer with what hear_stereo() gave: a file far above full
/// scale has been made softer there. Threads: any. Real-time: yes.
[[nodiscard]] inline Hearing after_stereo(const Hearing& hearing) noexcept {
    Hearing rest = hearing;
    if (rest.gain < 1.0F) {
        rest.offset *= rest.gain;
        rest.gain = 1.0F;
    }
    return rest;
}

/// Interleaved audio as the analyzer should hear it, one sample a frame: downmix_to_mono, changed
/// as `hearing` says. Threads: any. Real-time: yes.
void hear_mono(std::span<const float> interleaved,
               std::size_t channels,
               const Hearing& hearing,
               std::span<float> mono) noexcept RAKS_NONBLOCKING;

/// The same as stereo for a loudspeaker or a film: downmix_to_stereo, and softer where the file is
/// far above full scale; everything else stays as the file has it. Threads: any. Real-time: yes.
void hear_stereo(std::span<const float> interleaved,
                 std::size_t channels,
                 const Hearing& hearing,
                 std::span<float> stereo) noexcept;

}  // namespace raks::audio
