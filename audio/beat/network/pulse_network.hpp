#pragma once

#include <array>
#include <cstddef>

#include "audio/beat/network/pulse_input.hpp"
#include "audio/beat/network/rival_list.hpp"
#include "base/realtime.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// Which pulse is the beat of the music: probabilities that sum to 1. First that of the pulse which
/// is followed, then those of kRivalPulses as seen from this beat (it counts as position 0).
using PulseEvidence = std::array<float, 1 + kRivalPulses.size()>;

/// A recurrent network for the metre: one frame a beat of the pulse that is followed (PulseInput),
/// a softmax over that pulse and its rivals. Weights only; immutable once built. Threads: any may
/// read.
class PulseNetwork : public models::RecurrentNetwork {
 public:
    /// The pulse that is followed, and its rivals.
    static constexpr std::size_t kOutputs = std::tuple_size_v<PulseEvidence>;
    /// Input of one beat.
    using Frame = PulseInput::Frame;
    /// Output for one beat.
    using Evidence = PulseEvidence;

    /// All parameters 0. `units`: of each of the `layers`.
    PulseNetwork(std::size_t units, std::size_t layers)
        : models::RecurrentNetwork({PulseInput::kSize, units, layers, kOutputs}) {}

    /// Softmax of the outputs. Real-time: yes.
    static PulseEvidence evidence_of(const models::RecurrentStream::Logits& logits) noexcept
        RAKS_NONBLOCKING;
};

/// State of a PulseNetwork over a stream, beat by beat. Threads: one.
using PulseNetworkStream = models::NetworkStream<PulseNetwork>;

}  // namespace raks::audio
