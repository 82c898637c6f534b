#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audio/beat/network/confidence_model.hpp"
#include "audio/features/network_input.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// A network's output for one hop: probabilities, each in [0, 1], not exclusive.
struct BeatEvidence {
    float beat = 0.0F;      ///< of a beat here (downbeats included)
    float downbeat = 0.0F;  ///< of the first beat of a bar
    float half = 0.0F;      ///< of the middle between two beats
    float third = 0.0F;     ///< of a third or two thirds of a beat that has three parts
};

class BarNetwork;    // audio/beat/network/bar_network.hpp
class PulseNetwork;  // audio/beat/network/pulse_network.hpp
struct BeatNet;      // audio/beat/network/beatnet.hpp

/// A recurrent network for beats: four logistic outputs over the NetworkInput of each hop. Weights
/// only; immutable once built. Threads: any may read.
class BeatNetwork : public models::RecurrentNetwork {
 public:
    static constexpr std::size_t kOutputs = 4;  ///< beat, downbeat, half, third
    /// Input of one hop.
    using Frame = NetworkInput::Frame;
    /// Output for one hop.
    using Evidence = BeatEvidence;

    /// All parameters 0. `units`: of each of the `layers`. `lookahead`: hops by which the evidence
    /// comes after the sound that it is about.
    BeatNetwork(std::size_t units, std::size_t layers, int lookahead)
        : models::RecurrentNetwork({NetworkInput::kSize, units, layers, kOutputs}),
          lookahead_(lookahead) {}

    /// Hops between a sound and its evidence.
    [[nodiscard]] int lookahead() const noexcept { return lookahead_; }

    /// The network for bars that goes with this one (bar_network.hpp). Null: bars follow from the
    /// evidence of single downbeats.
    [[nodiscard]] const std::shared_ptr<const BarNetwork>& bars() const noexcept { return bars_; }
    /// Sets it, while building.
    void set_bars(std::shared_ptr<const BarNetwork> bars) noexcept { bars_ = std::move(bars); }

    /// The network for the metre that goes with this one (pulse_network.hpp). Null: what single
    /// beats say decides.
    [[nodiscard]] const std::shared_ptr<const PulseNetwork>& pulses() const noexcept {
        return pulses_;
    }
    /// Sets it, while building.
    void set_pulses(std::shared_ptr<const PulseNetwork> pulses) noexcept {
        pulses_ = std::move(pulses);
    }

    /// How sure its beats are, as they come and known ahead.
    [[nodiscard]] const ConfidenceModel& confidence() const noexcept { return confidence_; }
    /// Sets it, while building.
    void set_confidence(const ConfidenceModel& model) noexcept { confidence_ = model; }

    /// BeatNet, which is heard beside this one (beatnet.hpp). Null: it is not.
    [[nodiscard]] const std::shared_ptr<const BeatNet>& beatnet() const noexcept {
        return beatnet_;
    }
    /// Sets it, while building.
    void set_beatnet(std::shared_ptr<const BeatNet> beatnet) noexcept {
        beatnet_ = std::move(beatnet);
    }

    /// Further networks of an ensemble, each with the same look-ahead: their outputs are averaged
    /// with this one's. They have neither further networks nor bars of their own.
    [[nodiscard]] const std::vector<std::shared_ptr<const BeatNetwork>>& others() const noexcept {
        return others_;
    }
    /// Sets them, while building.
    void set_others(std::vector<std::shared_ptr<const BeatNetwork>> others) noexcept {
        others_ = std::move(others);
    }

    /// Logistic function of the outputs. Real-time: yes.
    static BeatEvidence evidence_of(const models::RecurrentStream::Logits& logits) noexcept
        RAKS_NONBLOCKING;

 private:
    int lookahead_;
    std::shared_ptr<const BarNetwork> bars_;
    std::shared_ptr<const PulseNetwork> pulses_;
    std::shared_ptr<const BeatNet> beatnet_;
    ConfidenceModel confidence_;
    std::vector<std::shared_ptr<const BeatNetwork>> others_;
};

/// One network with the mean weights of several that were trained on from the same weights: its
/// outputs are about those of their ensemble (Wortsman et al. 2022, "Model soups"). Networks for
/// bars are left out, as they learn from the output of one network.
/// Errors: no network; an ensemble among them; "3: has another shape than the first", counted from
/// 1.
[[nodiscard]] Expected<BeatNetwork> average(
    std::span<const std::shared_ptr<const BeatNetwork>> networks);

/// Most networks of an ensemble.
constexpr std::size_t kMostTogether = 8;
/// An ensemble of networks that were trained apart: each errs in its own way. Their outputs are
/// averaged before the logistic function, times `trust`: below 1 where they are more certain on
/// music like their training music than they are right on other music. Networks for bars are left
/// out, as above. Errors: no network; more than kMostTogether; "3: has another look-ahead than the
/// first".
[[nodiscard]] Expected<BeatNetwork> together(
    std::span<const std::shared_ptr<const BeatNetwork>> networks, float trust);

/// State of a network and its ensemble over a stream, hop by hop. Cost: a step of each network.
/// Threads: one. Real-time: next, reset yes.
class BeatNetworkStream {
 public:
    /// Starts from zero states. `network`: not null.
    explicit BeatNetworkStream(std::shared_ptr<const BeatNetwork> network)
        : network_(std::move(network)), streams_(1 + network_->others().size()) {}

    /// Evidence for the hop that lies the network's look-ahead before this frame.
    BeatEvidence next(const NetworkInput::Frame& frame) noexcept RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    std::shared_ptr<const BeatNetwork> network_;
    std::vector<models::RecurrentStream> streams_;  // the network's, then one of each of the others
};

}  // namespace raks::audio
