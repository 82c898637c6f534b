#include "audio/beat/network/beat_network.hpp"

#include <algorithm>
#include <string>

#include "models/gates.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

// A copy without bars and ensemble; its output weights times `trust`, which scales the outputs
// before the logistic function.
BeatNetwork alone_and_trusted(const BeatNetwork& network, float trust) {
    BeatNetwork result(network.units(), network.layers().size(), network.lookahead());
    std::copy(
        network.parameters().begin(), network.parameters().end(), result.parameters().begin());
    for (float& weight : result.parameters().subspan(result.output_weights())) {
        weight *= trust;
    }
    return result;
}

}  // namespace

// The mean of weights makes sense only between networks of one shape.
Expected<BeatNetwork> average(std::span<const std::shared_ptr<const BeatNetwork>> networks) {
    if (networks.empty()) {
        return fail("0: there is none");
    }
    const BeatNetwork& first = *networks.front();
    BeatNetwork mean(first.units(), first.layers().size(), first.lookahead());
    for (std::size_t n = 0; n < networks.size(); ++n) {
        const BeatNetwork& one = *networks[n];
        if (!one.others().empty()) {
            return fail(std::to_string(n + 1) + ": holds several networks");
        }
        if (one.shape() != mean.shape() || one.lookahead() != mean.lookahead()) {
            return fail(std::to_string(n + 1) + ": has another shape than the first");
        }
        for (std::size_t i = 0; i < one.parameters().size(); ++i) {
            mean.parameters()[i] += one.parameters()[i] / static_cast<float>(networks.size());
        }
    }
    return mean;
}

Expected<BeatNetwork> together(std::span<const std::shared_ptr<const BeatNetwork>> networks,
                               float trust) {
    if (networks.empty()) {
        return fail("0: there is none");
    }
    // Ensembles among the given networks are taken apart, as their members have none of their own.
    std::vector<std::shared_ptr<const BeatNetwork>> members;
    for (const auto& given : networks) {
        members.push_back(given);
        members.insert(members.end(), given->others().begin(), given->others().end());
    }
    if (members.size() > kMostTogether) {
        return fail(fmt::format("{}: at most {} together", members.size(), kMostTogether));
    }
    for (std::size_t n = 0; n < members.size(); ++n) {
        const auto& one = *members[n];
        // One look-ahead: the members' outputs are averaged hop by hop.
        if (one.lookahead() != members.front()->lookahead()) {
            return fail(fmt::format("{}: has another look-ahead than the first", n + 1));
        }
        members[n] = std::make_shared<const BeatNetwork>(alone_and_trusted(one, trust));
    }
    BeatNetwork first = *members.front();
    first.set_others({members.begin() + 1, members.end()});
    return first;
}

// The mean of the outputs before the logistic function.
BeatEvidence BeatNetworkStream::next(const NetworkInput::Frame& frame) noexcept RAKS_NONBLOCKING {
    models::RecurrentStream::Logits sum = streams_[0].next(*network_, frame);
    for (std::size_t i = 1; i < streams_.size(); ++i) {
        const auto more = streams_[i].next(*network_->others()[i - 1], frame);
        for (std::size_t output = 0; output < BeatNetwork::kOutputs; ++output) {
            sum[output] += more[output];
        }
    }
    for (float& logit : sum) {
        logit /= static_cast<float>(streams_.size());
    }
    return BeatNetwork::evidence_of(sum);
}

void BeatNetworkStream::reset() noexcept RAKS_NONBLOCKING {
    for (models::RecurrentStream& stream : streams_) {
        stream.reset();
    }
}

BeatEvidence BeatNetwork::evidence_of(const models::RecurrentStream::Logits& logits) noexcept
    RAKS_NONBLOCKING {
    return {models::logistic(logits[0]),
            models::logistic(logits[1]),
            models::logistic(logits[2]),
            models::logistic(logits[3])};
}

}  // namespace raks::audio
