#pragma once

#include <memory>
#include <span>

#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Converts audio from one sample rate to another: one channel between rates of a simple ratio by a
/// filter of our own (PolyphaseResampler), all else by libspeexdsp at quality 5, whose filter is
/// the same: 80 taps at the lower of the two rates. Output frame k belongs exactly to time k / to;
/// it only comes out later, by delay(). Any division of the input into calls gives the same output
/// bits. With equal rates it copies.
///
/// Why: docs/decisions/0001. Threads: one. Real-time: process and reset yes, prepare no.
class Resampler {
 public:
    /// Call prepare() before anything else.
    Resampler();
    /// Frees the library's state.
    ~Resampler();
    /// Movable, not copyable.
    Resampler(Resampler&&) noexcept;
    /// As above.
    Resampler& operator=(Resampler&&) noexcept;

    /// Sets up the conversion and measures its delay. `channels`: interleaved, >= 1. Errors: the
    /// library cannot be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate from, SampleRate to, int channels = 1);

    /// What one call of process() did; a frame is one sample of each channel.
    struct Progress {
        std::size_t taken = 0;  ///< frames of `input`
        std::size_t made = 0;   ///< frames of `output`
    };
    /// Takes as many of the interleaved frames as it can and makes as many as fit; call again until
    /// all of `input` is taken.
    Progress process(std::span<const float> input,
                     std::span<float> output) noexcept RAKS_NONBLOCKING;

    /// Forgets the samples inside, for instance after a seek: the next input frame is frame 0.
    void reset() noexcept RAKS_NONBLOCKING;

    /// Longest time from an input frame to the output frame of the same time, as measured by
    /// prepare(); 0 with equal rates.
    [[nodiscard]] Nanos delay() const noexcept;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
