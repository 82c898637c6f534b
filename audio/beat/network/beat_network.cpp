#include "audio/beat/network/beat_network.hpp"

#include "audio/math/gates.hpp"

namespace raks::audio {

Expected<BeatNetwork> average(std::span<const std::shared_ptr<const BeatNetwork>> networks) {
    if (networks.empty()) {
        return fail("0: there is none");
    }
    const BeatNetwork& first = *networks.front();
    BeatNetwork mean(first.units(), first.layers().size(), first.lookahead());
    for (std::size_t n = 0; n < networks.size(); ++n) {
        const BeatNetwork& one = *networks[n];
        if (one.shape() != mean.shape() || one.lookahead() != mean.lookahead()) {
            return fail(std::to_string(n + 1) + ": has another shape than the first");
        }
        for (std::size_t i = 0; i < one.parameters().size(); ++i) {
            mean.parameters()[i] += one.parameters()[i] / static_cast<float>(networks.size());
        }
    }
    return mean;
}

BeatEvidence BeatNetwork::evidence_of(const RecurrentStream::Logits& logits) noexcept
    RAKS_NONBLOCKING {
    return {logistic(logits[0]), logistic(logits[1]), logistic(logits[2])};
}

}  // namespace raks::audio
