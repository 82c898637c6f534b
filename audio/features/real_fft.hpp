#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/realtime.hpp"

namespace raks::audio {

/// Power spectrum of real samples by a Fourier transform of our own: within 1e-6 of the greatest
/// bin of one in double precision, and the same bits on every machine.
///
/// The samples are taken for half as many complex ones, which are dealt out to 8 lanes; the lanes'
/// transforms (Stockham's, radix 4) run side by side in one register, and one of length 8 over the
/// lanes joins them (Bailey 1990, "FFTs in external or hierarchical memory"). So every loop works
/// on whole registers. 8,200 instructions (AVX2) for 1,024 samples, a twelfth of kissfft's.
/// Threads: one. Real-time: compute yes.
class RealFft {
 public:
    /// `size`: of the transform, a power of two from 128 to 65,536.
    explicit RealFft(std::size_t size);

    /// power[k] = |sum over i of samples[i] e^(-2 pi j i k / size)|^2, k = 0 .. size / 2.
    /// `samples`: `size`; `power`: size / 2 + 1.
    void power_spectrum(std::span<const float> samples,
                        std::span<float> power) noexcept RAKS_NONBLOCKING;

 private:
    std::size_t points_;        // complex ones: half the size
    std::vector<float> turns_;  // e^(-2 pi j p / n) of the lanes' transforms: cosines, sines
    std::vector<float>
        lane_turns_;  // by which the lanes' results are turned before they are joined
    std::vector<float> real_turns_;  // by which the halves of the real transform are joined
    // Real parts, then imaginary ones; room for a register beyond, twice: a pass goes from the one
    // to the other.
    std::vector<float> work_;
    std::vector<float> other_;
};

}  // namespace raks::audio
