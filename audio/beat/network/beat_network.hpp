#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audio/features/network_input.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// What the network says of one hop: probabilities, each [0, 1], not exclusive.
struct BeatEvidence {
    float beat = 0.0F;      ///< a beat is here (a downbeat too)
    float downbeat = 0.0F;  ///< the first beat of a bar
    float half = 0.0F;      ///< half way between two beats
};

class BarNetwork;

/// A recurrent network that hears beats: three logistic outputs over the NetworkInput of each hop.
/// Weights only; immutable once built. Threads: any may read.
class BeatNetwork : public models::RecurrentNetwork {
 public:
    static constexpr std::size_t kOutputs = 3;
    using Frame = NetworkInput::Frame;
    using Evidence = BeatEvidence;

    /// All parameters 0. `lookahead`: hops by which its evidence comes after the sound that it is
    /// about.
    BeatNetwork(std::size_t units, std::size_t layers, int lookahead)
        : models::RecurrentNetwork({NetworkInput::kSize, units, layers, kOutputs}),
          lookahead_(lookahead) {}

    [[nodiscard]] int lookahead() const noexcept { return lookahead_; }

    /// Hears bars from what this one hears of beats (bar_network.hpp). None: bars are told by the
    /// evidence of single downbeats.
    [[nodiscard]] const std::shared_ptr<const BarNetwork>& bars() const noexcept { return bars_; }
    void set_bars(std::shared_ptr<const BarNetwork> bars) noexcept { bars_ = std::move(bars); }

    /// Others that hear the same beside it, each with the same look-ahead: what they say is
    /// averaged with what it says. They have neither others nor bars of their own.
    [[nodiscard]] const std::vector<std::shared_ptr<const BeatNetwork>>& others() const noexcept {
        return others_;
    }
    void set_others(std::vector<std::shared_ptr<const BeatNetwork>> others) noexcept {
        others_ = std::move(others);
    }

    /// Real-time: yes.
    static BeatEvidence evidence_of(const models::RecurrentStream::Logits& logits) noexcept
        RAKS_NONBLOCKING;

 private:
    int lookahead_;
    std::shared_ptr<const BarNetwork> bars_;
    std::vector<std::shared_ptr<const BeatNetwork>> others_;
};

/// The mean of the weights of networks that went on from one and the same: they lie in one valley,
/// and their mean hears like all of them together (Wortsman et al. 2022, "Model soups").
/// What hears bars is left out: it learns from what one network says of beats.
/// Errors: none given, or "3: has another shape than the first", counted from 1.
[[nodiscard]] Expected<BeatNetwork> average(
    std::span<const std::shared_ptr<const BeatNetwork>> networks);

/// Networks that learnt apart, heard together: each errs in its own way. What they say is averaged
/// before it is squashed, times `trust`: below 1 where they are surer of what they learnt from
/// than of other music. What hears bars is left out, as above.
/// Errors: none given, more than kMostTogether, or "3: has another look-ahead than the first".
constexpr std::size_t kMostTogether = 8;
[[nodiscard]] Expected<BeatNetwork> together(
    std::span<const std::shared_ptr<const BeatNetwork>> networks, float trust);

/// Listens with a network and those beside it, hop by hop. Cost: a step of each.
/// Threads: one. Real-time: next, reset yes.
class BeatNetworkStream {
 public:
    /// `network`: not null.
    explicit BeatNetworkStream(std::shared_ptr<const BeatNetwork> network)
        : network_(std::move(network)), streams_(1 + network_->others().size()) {}

    /// About what lies the network's look-ahead before the frame.
    BeatEvidence next(const NetworkInput::Frame& frame) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    std::shared_ptr<const BeatNetwork> network_;
    std::vector<models::RecurrentStream> streams_;  // the network's, then one of each of the others
};

}  // namespace raks::audio
