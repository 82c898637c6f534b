#include "audio/beat/network/bar_network.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {

BarEvidence BarNetwork::evidence_of(const models::RecurrentStream::Logits& logits) noexcept
    RAKS_NONBLOCKING {
    // Softmax; the greatest output is subtracted first, so that exp does not overflow.
    const float most = std::max({logits[0], logits[1], logits[2]});
    const float first = std::exp(logits[0] - most);
    const float middle = std::exp(logits[1] - most);
    const float other = std::exp(logits[2] - most);
    const float sum = first + middle + other;
    return {first / sum, middle / sum, other / sum};
}

}  // namespace raks::audio
