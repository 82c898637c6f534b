#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Stereo from one rate to another for the loudspeaker's path (libsamplerate SINC_FASTEST: 0.4 ms
/// of delay, no allocation while it runs). With equal rates it copies. Threads: one. Real-time:
/// process and reset yes, prepare no.
class StereoResampler {
 public:
    StereoResampler();
    ~StereoResampler();
    StereoResampler(StereoResampler&&) noexcept;
    StereoResampler& operator=(StereoResampler&&) noexcept;

    /// Errors: libsamplerate cannot be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate from, SampleRate to);

    struct Progress {
        std::size_t frames_taken = 0;  ///< of `input`
        std::size_t frames_made = 0;   ///< of `output`
    };
    /// Takes interleaved stereo and makes as much as fits.
    Progress process(std::span<const float> input,
                     std::span<float> output) noexcept RAKS_NONBLOCKING;

    /// Forgets what is inside (after a seek).
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
