#pragma once

#include <span>
#include <vector>

#include "audio/features/mfcc.hpp"
#include "audio/resample/resampler.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// MFCC-39 of a stream of any rate, one vector with each hop of the analyzer: samples go in as they
/// come, next() hands out what belongs to one more hop. One window a hop, so that no hop costs more
/// than another.
///
///     hops.push(chunk);                                   // samples at the source's rate
///     const MfccVector* vector = hops.next();             // once a hop
///
/// next() of hop n takes the samples at 16 kHz before time_of_hop(n) + 10 ms. Its caller knows that
/// they are in: samples at 16 kHz come out of the resampler up to 5 ms after the source's.
/// Threads: one. Real-time: all but prepare.
class MfccHops {
 public:
    /// How far the middle of the window of next()'s vector lies before its hop: 40 ms for the four
    /// frames that the derivatives need, and 7.5 ms as the window of 25 ms ends 5 ms after the hop.
    static constexpr Nanos kAge = std::chrono::microseconds(47'500);
    static constexpr int kHopsBehind = 5;  ///< the hop nearest to that middle

    /// Errors: no resampler can be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate rate, const MfccConfig& config = {});

    /// The stream goes on at another rate; what was resampled stays. Errors: as prepare().
    [[nodiscard]] Expected<void> change_rate(SampleRate rate);
    /// Samples at 16 kHz that wait for next().
    [[nodiscard]] std::size_t waiting() const noexcept { return queued_; }

    /// Samples in [-1, 1] at the source's rate. Those that wait for next() must be fewer than 256
    /// ms.
    void push(std::span<const float> mono) noexcept RAKS_NONBLOCKING;

    /// The vector that became complete with this hop; nullptr in the first hops of a stream and
    /// after a gap. Valid until the next call.
    [[nodiscard]] const MfccVector* next() noexcept RAKS_NONBLOCKING;

    /// The samples at 16 kHz that the following next() takes, on the scale of 16 bits; fewer than a
    /// hop's where its caller has broken its promise.
    [[nodiscard]] std::span<const float> coming() const noexcept RAKS_NONBLOCKING;
    static constexpr float kScale = 32768.0F;  ///< of coming(): HTK's

    /// Puts this many samples of silence at 16 kHz in place of samples that were lost.
    void push_lost(int samples) noexcept RAKS_NONBLOCKING;
    /// In place of next() for a hop inside a gap, or one whose MFCC nobody wants: discards the
    /// hop's samples, and frames start anew after it.
    void discard() noexcept RAKS_NONBLOCKING;
    /// Forgets the stream, as after prepare().
    void reset() noexcept RAKS_NONBLOCKING;

    /// Longest time from a source sample to its place at 16 kHz.
    [[nodiscard]] Nanos resampling_delay() const noexcept { return resampler_.delay(); }

 private:
    Resampler resampler_;
    MfccStream stream_;
    std::vector<float> queue_;  // resampled, waiting for their hop; 16-bit scale
    std::size_t queued_ = 0;
    MfccVector newest_{};
};

}  // namespace raks::audio
