#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "audio/beat/network/beatnet.hpp"
#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// BeatNet over the analyzer's hops of 10 ms: its frames are two hops apart, and between them the
/// mean of both neighbours counts.
///
/// Threads: one. Real-time: all but the constructor. Every second hop costs a frame.
class BeatNetHops {
 public:
    /// Hops by which the evidence is late: a frame looks 32 ms ahead, an analyzer's window 16 ms,
    /// and a hop between two frames waits for the later one.
    static constexpr int kLag = 3;

    /// `network`: not null.
    explicit BeatNetHops(std::shared_ptr<const BeatNet> network) : stream_(std::move(network)) {}

    /// Takes the next hop's window; returns the evidence about the hop kLag hops before it.
    BeatNetEvidence next(std::span<const float, OnsetDetector::kWindow> window) noexcept
        RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr int kFirstFrame = 2;
    static constexpr std::size_t kHop = OnsetDetector::kHop;
    // The first frame's middle lies two hops before the newest window's.
    static constexpr std::size_t kKept =
        BeatNetStream::kWindow / 2 + 2 * kHop + OnsetDetector::kWindow / 2;

    BeatNetStream stream_;
    std::array<float, kKept> samples_{};  // the newest, at the analyzer's rate
    int to_frame_ = kFirstFrame;          // hops until the next one that completes a frame
    BeatNetEvidence newest_;
    BeatNetEvidence before_;
};

}  // namespace raks::audio
