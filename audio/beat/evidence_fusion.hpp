#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "audio/beat/beat_detector.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "audio/beat/network/beatnet_hops.hpp"
#include "audio/features/network_input.hpp"
#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What the networks say of one hop.
struct FusedEvidence {
    BeatEvidence own;    ///< our own networks, which know written music
    BeatEvidence fused;  ///< with BeatNet, which knows recordings
};

/// Evidence of beats by our own networks and, where it is beside them, by BeatNet: the mean of both
/// probabilities. BeatNet knows no parts of a beat; where it is sure of a beat, what our own
/// say of halves and thirds counts for less.
///
/// Threads: one. Real-time: all but the constructor.
class EvidenceFusion {
 public:
    /// `network`: not null.
    explicit EvidenceFusion(const std::shared_ptr<const BeatNetwork>& network);

    /// Hops by which the evidence is late: that of the later of both.
    [[nodiscard]] int lag() const noexcept { return lag_; }

    /// Takes the next hop's input and window of samples; evidence about the hop lag() hops ago.
    FusedEvidence next(const NetworkInput::Frame& frame,
                       std::span<const float, OnsetDetector::kWindow> window) noexcept
        RAKS_NONBLOCKING;
    /// The sound continues elsewhere: BeatNet hears it from its beginning, and counts less at
    /// first.
    void jump() noexcept RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    // More hops than any network looks ahead.
    static constexpr std::size_t kWaiting = 16;

    BeatDetector detector_;
    std::optional<BeatNetHops> beatnet_;
    std::size_t own_wait_ = 0;      // hops that our own evidence waits for BeatNet's
    std::size_t beatnet_wait_ = 0;  // and BeatNet's for ours
    int lag_ = 0;
    int heard_ = 0;        // hops since reset(), at most those that BeatNet needs
    std::size_t now_ = 0;  // place of the newest hop in the rings
    std::array<BeatEvidence, kWaiting> own_{};
    std::array<BeatNetEvidence, kWaiting> other_{};
};

}  // namespace raks::audio
