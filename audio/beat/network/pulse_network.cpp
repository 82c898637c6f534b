#include "audio/beat/network/pulse_network.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {

// The greatest output is subtracted first, so that exp does not overflow.
PulseEvidence PulseNetwork::evidence_of(const models::RecurrentStream::Logits& logits) noexcept
    RAKS_NONBLOCKING {
    const float most = *std::max_element(logits.begin(), logits.begin() + kOutputs);
    PulseEvidence evidence{};
    float sum = 0.0F;
    for (std::size_t i = 0; i < kOutputs; ++i) {
        evidence[i] = std::exp(logits[i] - most);
        sum += evidence[i];
    }
    for (float& probability : evidence) {
        probability /= sum;
    }
    return evidence;
}

}  // namespace raks::audio
