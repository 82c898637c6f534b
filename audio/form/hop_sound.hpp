#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Bands of MusicAccent::Band: below 200 Hz, to 4 kHz, above.
inline constexpr std::size_t kFormBands = 3;

/// What of one hop tells about the form of the music. Levels in dB follow the input's; what has no
/// unit is taken over the level of the last seconds and does not change with it.
struct HopSound {
    float level = -120.0F;                  ///< dBFS of the hop's samples
    std::array<float, kFormBands> bands{};  ///< dB of the mel bands of each band, not below -120
    float top = -120.0F;  ///< likewise of those above 6 kHz, where cymbals and snares sound
    /// Mean rise of the logarithm of the mel bands over two hops, >= 0: how much begins, soft
    /// sounds included.
    std::array<float, kFormBands> novelty{};
    /// The same of loud sounds only: 1 is a rise by about the usual level.
    std::array<float, kFormBands> hits{};

    /// Novelty of all bands together.
    [[nodiscard]] float total_novelty() const noexcept {
        return novelty[0] + novelty[1] + novelty[2];
    }
    /// dB by which the high band lies over the low and the middle one.
    [[nodiscard]] float brightness() const noexcept;
};

/// Makes a HopSound of each hop. Threads: one. Real-time: yes.
class HopListener {
 public:
    static constexpr std::size_t kMelBands = OnsetDetector::kMelBands;  ///< numbers a hop

    /// The next hop. `level_dbfs`: of its samples; `mel`: OnsetDetector::mel_magnitudes().
    HopSound advance(float level_dbfs,
                     std::span<const float, kMelBands> mel) noexcept RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept { *this = HopListener(); }

 private:
    static constexpr std::size_t kHistory = 4;
    using Logs = std::array<float, kMelBands>;

    float usual_ = 0.0F;                 // running mean magnitude of a mel band
    std::array<Logs, kHistory> soft_{};  // of the last hops, ring: logarithms over a small share
    std::array<Logs, kHistory> loud_{};  // and over all of usual_
    std::size_t hops_ = 0;
};

}  // namespace raks::audio
