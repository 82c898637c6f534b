#pragma once

#include "audio/beat/network/bar_input.hpp"
#include "base/realtime.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// Place of a beat in its bar: probabilities that sum to 1.
struct BarEvidence {
    float first = 0.0F;   ///< of a bar of any length
    float middle = 0.0F;  ///< the third of four beats, the fourth of six
    float other = 0.0F;   ///< all other beats
};

/// A recurrent network for bars: one frame a beat (BarInput), a softmax over three classes. Weights
/// only; immutable once built. Threads: any may read.
class BarNetwork : public models::RecurrentNetwork {
 public:
    static constexpr std::size_t kOutputs = 3;  ///< first, middle, other
    /// Input of one beat.
    using Frame = BarInput::Frame;
    /// Output for one beat.
    using Evidence = BarEvidence;

    /// All parameters 0. `units`: of each of the `layers`.
    BarNetwork(std::size_t units, std::size_t layers)
        : models::RecurrentNetwork({BarInput::kSize, units, layers, kOutputs}) {}

    /// Softmax of the outputs. Real-time: yes.
    static BarEvidence evidence_of(const models::RecurrentStream::Logits& logits) noexcept
        RAKS_NONBLOCKING;
};

/// State of a BarNetwork over a stream, beat by beat. Threads: one.
using BarNetworkStream = models::NetworkStream<BarNetwork>;

}  // namespace raks::audio
