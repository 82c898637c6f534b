#pragma once

#include <array>
#include <span>
#include <vector>

#include "audio/features/spectrum.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Bands whose onsets are computed apart: below 0.4 kHz (bass drum, bass, conga), to 2.5 kHz
/// (voices, piano, snare) and above (hats, bells, shakers).
inline constexpr int kOnsetBands = 3;

/// Onset strength of one hop.
struct Onset {
    std::array<float, kOnsetBands> flux{};        ///< half-wave rectified log-mel flux, >= 0
    std::array<float, kOnsetBands> normalized{};  ///< flux in its running sd, [-0.8, 3.5]
    float strength = 0.0F;  ///< weighted sum of `normalized`: what the beat pointer follows
    float total = 0.0F;     ///< sum of `flux`, >= 0; 0 in silence
};

/// Onset strength at 32 kHz every 320 samples: log-mel bands, each against the maximum of two
/// earlier windows (a vibrato makes no onset), then normalized by a running mean and variance of
/// 4 s, which stand still while `is_silent`. (Spectral energy flux of Ofli 2008, 4.2, made robust
/// as in Boeck, Widmer 2013, "Maximum filter vibrato suppression".)
///
/// Threads: one. Real-time: compute, reset yes.
class OnsetDetector {
 public:
    static constexpr int kSampleRate = 32'000;  ///< hertz
    static constexpr int kHop = 320;            ///< samples: 10 ms
    static constexpr int kWindow = 1024;        ///< samples

    /// Plans the FFT and the mel filters.
    OnsetDetector();

    /// Onset strength of the next hop. `window`: kWindow samples around the hop's time, in [-1, 1].
    Onset compute(std::span<const float> window, bool is_silent) noexcept RAKS_NONBLOCKING;
    /// The same from mel magnitudes that a window gave before, see mel_magnitudes().
    Onset compute_from_mel(std::span<const float> magnitudes,
                           bool is_silent) noexcept RAKS_NONBLOCKING;
    /// Forgets the stream; the band limit stays.
    void reset() noexcept RAKS_NONBLOCKING;

    /// Tells that the source holds nothing above this many hertz. Bands that reach higher take the
    /// value of the highest whole band below, so that onsets have the same timing at any source
    /// rate.
    void limit_to(double hertz) noexcept;

    static constexpr int kMelBands = 36;  ///< 30 to 15,500 Hz
    /// The bands' magnitudes of the last window of compute(), not normalized.
    [[nodiscard]] std::span<const float, kMelBands> mel_magnitudes() const noexcept {
        return magnitudes_;
    }
    /// Mel magnitudes of a spectrum whose bins all have magnitude 1: the shape of white noise.
    [[nodiscard]] static std::array<float, kMelBands> white_magnitudes();

 private:
    static constexpr int kHistory = 4;
    using LogMel = std::array<float, kMelBands>;

    [[nodiscard]] std::array<float, kOnsetBands> flux_of(const LogMel& now) const noexcept;
    void normalize(Onset& onset) noexcept;

    PowerSpectrum spectrum_;
    FilterBank filters_;
    std::size_t whole_bands_ = kMelBands;        // mel bands below the source's limit
    std::array<float, kMelBands> magnitudes_{};  // of the mel bands
    std::array<LogMel, kHistory> history_{};     // of the last hops, ring
    int hops_ = 0;
    int hops_normalized_ = 0;
    std::array<float, kOnsetBands> mean_{};
    std::array<float, kOnsetBands> variance_{};
};

}  // namespace raks::audio
