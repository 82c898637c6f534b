#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Removes hiss from mel magnitudes. The hiss is taken for white noise, whose level is the highest
/// that can lie under the last 4 s: in these no band was ever below it, and in a quarter of the
/// bands the minimum is hardly above it. White noise has one level for all bands, so a band that
/// rests (the highest, in most music) shows that there is none; a floor for each band by itself
/// would remove held chords and reverberation, too. (Spectral subtraction: Boll 1979; minimum
/// statistics: Martin 2001.)
///
/// Threads: one. Real-time: all but the constructor.
class NoiseFloor {
 public:
    static constexpr std::size_t kBands = OnsetDetector::kMelBands;  ///< mel bands
    /// One magnitude a band.
    using Bands = std::array<float, kBands>;

    /// Ready for the first hop.
    NoiseFloor();

    /// Takes a hop of sound (leave silence out) and returns its magnitudes without the noise, each
    /// >= 0. `magnitudes`: OnsetDetector::mel_magnitudes(). Valid until the next call. The first
    /// 0.6 s are returned unchanged.
    [[nodiscard]] const Bands& subtract(std::span<const float, kBands> magnitudes) noexcept
        RAKS_NONBLOCKING;
    /// Level of the noise: mean magnitude of a bin of the spectrum; 0: none was found.
    [[nodiscard]] float level() const noexcept { return level_; }
    /// Forgets the stream; the level is 0.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::size_t kBlocks = 8;

    void keep_least() noexcept;
    [[nodiscard]] float level_under() const noexcept;

    Bands white_{};                        // mel magnitudes of white noise whose bins are 1
    Bands smoothed_{};                     // magnitudes after the low-pass
    Bands least_{};                        // minimum of smoothed_ in the open block
    std::array<Bands, kBlocks> blocks_{};  // minima of the last blocks, ring
    std::int64_t hops_ = 0;
    float level_ = 0.0F;
    Bands quiet_{};  // the newest hop without the noise
};

}  // namespace raks::audio
