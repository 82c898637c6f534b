#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Momentary loudness (400 ms, EBU R 128) of a mono stream: the mean square behind the K filter of
/// ITU-R BS.1770, summed by blocks of 2 ms, so that nothing is summed twice but the blocks.
/// Within 0.001 dB of libebur128.
/// Threads: one. Real-time: all but the constructor.
class LoudnessMeter {
 public:
    /// `rate`: a multiple of 500 Hz, 8 kHz at least.
    explicit LoudnessMeter(SampleRate rate);

    /// Adds samples in [-1, 1].
    void add(std::span<const float> mono) noexcept RAKS_NONBLOCKING;
    /// LUFS of the last 400 ms that ended with a whole block, >= -120. What lies before the first
    /// sample counts as silence.
    [[nodiscard]] float momentary() const noexcept RAKS_NONBLOCKING;
    /// Forgets what was added.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr int kBlocksASecond = 500;
    static constexpr std::size_t kBlocks = 200;  // 400 ms

    // A filter of second order: b by the samples, a by its own output; a0 is 1.
    struct Shelf {
        std::array<double, 3> b{};
        std::array<double, 2> a{};
    };
    // What two filters keep from sample to sample, each in the transposed direct form II.
    struct Memory {
        double shelf1 = 0.0;
        double shelf2 = 0.0;
        double pass1 = 0.0;
        double pass2 = 0.0;
    };

    void add_to_open(std::span<const float> mono) noexcept;

    std::size_t block_samples_;
    Shelf shelf_;                   // what a head adds in the treble
    std::array<double, 2> pass_{};  // a of what takes away the bass; its b are 1, -2 and 1
    Memory memory_;
    double open_ = 0.0;                     // sum of squares in the open block
    std::size_t in_open_ = 0;               // samples in it
    std::array<double, kBlocks> blocks_{};  // sums of squares of the last blocks, ring
    std::size_t next_ = 0;                  // place in blocks_
};

}  // namespace raks::audio
