#pragma once

#include <memory>
#include <span>

#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Mono from any supported rate to an analysis rate (libsamplerate SINC_FASTEST). Output sample k
/// belongs to time k / to exactly; only its coming out is late, by delay(). Any partition of the
/// input gives the same output bits. With equal rates it copies.
///
/// FASTEST and not MEDIUM: it alone costs 1/144 of real time, MEDIUM 1/79, more than all the rest
/// of the analysis; what it loses lies above 80 % of the band, where no onset is decided. Threads:
/// one. Real-time: process and reset yes, prepare no.
class Resampler {
 public:
    Resampler();
    ~Resampler();
    Resampler(Resampler&&) noexcept;
    Resampler& operator=(Resampler&&) noexcept;

    /// Errors: libsamplerate refuses the ratio.
    [[nodiscard]] Expected<void> prepare(SampleRate from, SampleRate to);

    struct Progress {
        std::size_t taken = 0;  ///< samples of `input`
        std::size_t made = 0;   ///< samples of `output`
    };
    /// Takes what it can and makes as much as fits; call again until all of `input` is taken.
    Progress process(std::span<const float> input,
                     std::span<float> output) noexcept RAKS_NONBLOCKING;

    void reset() noexcept RAKS_NONBLOCKING;

    /// Longest time from an input sample to the output sample of the same moment (measured when
    /// prepared).
    [[nodiscard]] Nanos delay() const noexcept;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
