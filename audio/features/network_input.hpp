#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/realtime.hpp"

namespace raks::audio {

/// What the networks of beat and genre see of one hop, from its mel magnitudes over a running level
/// (so that a quiet recording looks like a loud one): for each band the rise against the maximum of
/// three bands two hops ago, and for each two bands how loud they are.
///
/// Threads: one. Real-time: yes.
class NetworkInput {
 public:
    static constexpr std::size_t kBands = 36;
    static constexpr std::size_t kSize = kBands + kBands / 2;
    using Frame = std::array<float, kSize>;

    /// `mel_magnitudes`: kBands, of an unnormalized spectrum of samples in [-1, 1].
    Frame next(std::span<const float> mel_magnitudes) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING { *this = NetworkInput(); }

 private:
    using Bands = std::array<float, kBands>;
    float level_ = 0.0F;
    std::array<Bands, 2> history_{};  // of the last two hops, the older first
    int hops_ = 0;
};

}  // namespace raks::audio
