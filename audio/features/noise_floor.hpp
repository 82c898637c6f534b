#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Takes hiss out of mel magnitudes: the loudest white noise that may lie under the last 4 s, where
/// no band was ever softer than it and a quarter of them hardly louder. What subtracts each band's
/// own floor takes held chords and echoes, too; white noise has one level for all bands, so one
/// that rests (the highest, in most music) says that there is none. (Spectral subtraction: Boll
/// 1979; minimum statistics: Martin 2001.)
///
/// Threads: one. Real-time: all but the constructor.
class NoiseFloor {
 public:
    static constexpr std::size_t kBands = OnsetDetector::kMelBands;
    using Bands = std::array<float, kBands>;

    NoiseFloor();

    /// Takes a hop of sound (leave silence out) and gives its magnitudes without the noise, each
    /// >= 0. `magnitudes`: OnsetDetector::mel_magnitudes(). Valid until the next call. The first
    /// 0.6 s come out as they are.
    [[nodiscard]] const Bands& subtract(std::span<const float, kBands> magnitudes) noexcept
        RAKS_NONBLOCKING;
    /// Of the noise: mean magnitude of a bin of the spectrum; 0: none.
    [[nodiscard]] float level() const noexcept { return level_; }
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::size_t kBlocks = 8;

    void keep_least() noexcept;
    [[nodiscard]] float level_under() const noexcept;

    Bands white_{};                        // magnitudes of white noise whose bins are 1
    Bands smoothed_{};                     // of what comes
    Bands least_{};                        // of the open block
    std::array<Bands, kBlocks> blocks_{};  // the least of each, ring
    std::int64_t hops_ = 0;
    float level_ = 0.0F;
    Bands quiet_{};  // the newest hop without the noise
};

}  // namespace raks::audio
