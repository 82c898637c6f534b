#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>

#include "audio/network/network_input.hpp"
#include "audio/network/network_listener.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"

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
class BeatNetwork : public RecurrentNetwork {
 public:
    static constexpr std::size_t kOutputs = 3;
    using Frame = NetworkInput::Frame;
    using Evidence = BeatEvidence;

    /// All parameters 0. `lookahead`: hops by which its evidence comes after the sound that it is
    /// about.
    BeatNetwork(std::size_t units, std::size_t layers, int lookahead)
        : RecurrentNetwork({NetworkInput::kSize, units, layers, kOutputs}), lookahead_(lookahead) {}

    [[nodiscard]] int lookahead() const noexcept { return lookahead_; }

    /// Hears bars from what this one hears of beats (bar_network.hpp). None: bars are told by the
    /// evidence of single downbeats.
    [[nodiscard]] const std::shared_ptr<const BarNetwork>& bars() const noexcept { return bars_; }
    void set_bars(std::shared_ptr<const BarNetwork> bars) noexcept { bars_ = std::move(bars); }

    /// Real-time: yes.
    static BeatEvidence evidence_of(const RecurrentStream::Logits& logits) noexcept
        RAKS_NONBLOCKING;

 private:
    int lookahead_;
    std::shared_ptr<const BarNetwork> bars_;
};

/// The mean of the weights of networks that went on from one and the same: they lie in one valley,
/// and their mean hears like all of them together (Wortsman et al. 2022, "Model soups").
/// What hears bars is left out: it learns from what one network says of beats.
/// Errors: none given, or "3: has another shape than the first", counted from 1.
[[nodiscard]] Expected<BeatNetwork> average(
    std::span<const std::shared_ptr<const BeatNetwork>> networks);

/// Hop by hop.
using BeatListener = NetworkListener<BeatNetwork>;

}  // namespace raks::audio
