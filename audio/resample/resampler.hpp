#pragma once

#include <memory>
#include <span>

#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Sound from one rate to another (libspeexdsp, quality 5: 80 taps at the lower of the two rates).
/// Output frame k belongs to time k / to exactly; only its coming out is late, by delay(). Any
/// partition of the input gives the same output bits. With equal rates it copies.
///
/// Why this library: docs/decisions/0001. Threads: one. Real-time: process and reset yes, prepare
/// no.
class Resampler {
 public:
    Resampler();
    ~Resampler();
    Resampler(Resampler&&) noexcept;
    Resampler& operator=(Resampler&&) noexcept;

    /// Errors: the library cannot be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate from, SampleRate to, int channels = 1);

    struct Progress {
        std::size_t taken = 0;  ///< frames of `input`
        std::size_t made = 0;   ///< frames of `output`
    };
    /// Takes what it can of the interleaved frames and makes as many as fit; call again until all
    /// of `input` is taken.
    Progress process(std::span<const float> input,
                     std::span<float> output) noexcept RAKS_NONBLOCKING;

    /// Forgets what is inside (after a seek).
    void reset() noexcept RAKS_NONBLOCKING;

    /// Longest time from an input frame to the output frame of the same moment (measured when
    /// prepared).
    [[nodiscard]] Nanos delay() const noexcept;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
