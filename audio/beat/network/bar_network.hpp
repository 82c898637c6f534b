#pragma once

#include "audio/beat/network/bar_input.hpp"
#include "base/realtime.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// What a beat is in its bar: probabilities that sum to 1.
struct BarEvidence {
    float first = 0.0F;   ///< of a bar of any length
    float middle = 0.0F;  ///< the third of four, the fourth of six
    float other = 0.0F;
};

/// A recurrent network that hears bars: one frame a beat (BarInput), a choice of three. Weights
/// only; immutable once built. Threads: any may read.
class BarNetwork : public models::RecurrentNetwork {
 public:
    static constexpr std::size_t kOutputs = 3;  ///< first, middle, other
    using Frame = BarInput::Frame;
    using Evidence = BarEvidence;

    /// All parameters 0.
    BarNetwork(std::size_t units, std::size_t layers)
        : models::RecurrentNetwork({BarInput::kSize, units, layers, kOutputs}) {}

    /// Real-time: yes.
    static BarEvidence evidence_of(const models::RecurrentStream::Logits& logits) noexcept
        RAKS_NONBLOCKING;
};

/// Beat by beat.
using BarNetworkStream = models::NetworkStream<BarNetwork>;

}  // namespace raks::audio
