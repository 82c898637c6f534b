#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Converts one channel between two rates whose ratio is that of small integers L / M: each output
/// sample is the product of the samples around it with one of L rows of a low-pass filter. The
/// filter is that of libspeexdsp at quality 5: a sinc under a Kaiser window (beta 10), 80 taps at
/// the lower of the two rates, -6 dB at 0.922 of its band (0.94 where the rate rises), and more
/// than 95 dB down from the band's end on.
///
/// Output sample k belongs exactly to time k / to. The same bits on every machine and for any
/// division of the input into calls. Cost: 81 instructions (AVX2) an output sample
/// from 48 to 32 kHz, a third of libspeexdsp's (docs/decisions/0001).
/// Threads: one. Real-time: process, reset yes.
class PolyphaseResampler {
 public:
    /// None where the rows would be more than 256 kB, as between 11,025 Hz and 32 kHz.
    [[nodiscard]] static std::optional<PolyphaseResampler> create(SampleRate from, SampleRate to);

    /// What one call of process() did, in samples.
    struct Progress {
        std::size_t taken = 0;  ///< of `input`
        std::size_t made = 0;   ///< of `output`
    };
    /// Takes as many samples as it can and makes as many as fit.
    Progress process(std::span<const float> input,
                     std::span<float> output) noexcept RAKS_NONBLOCKING;
    /// Forgets the samples inside: the next input sample is sample 0.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    PolyphaseResampler(std::size_t phases, std::size_t step, std::size_t taps);

    std::size_t phases_;         // L: rows
    std::size_t step_;           // M: by which the phase goes on with each output sample
    std::size_t taps_;           // of a row; a multiple of 8
    std::vector<float> rows_;    // phases_ x taps_
    std::vector<float> buffer_;  // input samples that are still needed, the oldest first
    std::size_t filled_ = 0;     // samples in buffer_
    std::size_t at_ = 0;         // the first of those that the next output sample needs
    std::size_t phase_ = 0;      // its row
};

}  // namespace raks::audio
