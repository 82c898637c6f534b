#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/realtime.hpp"

namespace raks::audio {

/// The input of the beat and genre networks for one hop, from its mel magnitudes relative to a
/// running level, so that a quiet recording gives the same input as a loud one. For each band: how
/// far its log magnitude rises above the maximum of three neighbouring bands two hops before. For
/// each pair of bands: its mean log magnitude.
///
/// Threads: one. Real-time: yes.
class NetworkInput {
 public:
    static constexpr std::size_t kBands = 36;                  ///< mel bands
    static constexpr std::size_t kSize = kBands + kBands / 2;  ///< numbers of one hop
    /// Inputs of one hop: kBands rises, then kBands / 2 levels.
    using Frame = std::array<float, kSize>;

    /// Input of the next hop. `mel_magnitudes`: kBands, of an unnormalized spectrum of samples in
    /// [-1, 1] (OnsetDetector::mel_magnitudes()).
    Frame next(std::span<const float> mel_magnitudes) noexcept RAKS_NONBLOCKING;
    /// Forgets level and history.
    void reset() noexcept RAKS_NONBLOCKING { *this = NetworkInput(); }

 private:
    using Bands = std::array<float, kBands>;
    float level_ = 0.0F;
    std::array<Bands, 2> history_{};  // of the last two hops, the older first
    int hops_ = 0;
};

}  // namespace raks::audio
