#pragma once

#include <memory>

#include "audio/beat/network/bar_input.hpp"
#include "audio/network/recurrent_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What a beat is in its bar: probabilities that sum to 1.
struct BarEvidence {
    float first = 0.0F;   ///< of a bar of any length
    float middle = 0.0F;  ///< the third of four, the fourth of six
    float other = 0.0F;
};

/// A recurrent network that hears bars: one frame a beat (BarInput), a choice of three. Weights
/// only; immutable once built. Threads: any may read.
class BarNetwork : public RecurrentNetwork {
 public:
    static constexpr std::size_t kOutputs = 3;  ///< first, middle, other

    /// All parameters 0.
    BarNetwork(std::size_t units, std::size_t layers)
        : RecurrentNetwork({BarInput::kSize, units, layers, kOutputs}) {}
};

/// Listens with one network, beat by beat.
/// Threads: one. Real-time: next, reset yes.
class BarListener {
 public:
    explicit BarListener(std::shared_ptr<const BarNetwork> network);

    /// About the beat that `input` is of.
    BarEvidence next(const BarInput::Frame& input) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING { stream_.reset(); }

 private:
    std::shared_ptr<const BarNetwork> network_;
    RecurrentStream stream_;
};

}  // namespace raks::audio
