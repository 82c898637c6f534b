#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "audio/beat/network/beat_network.hpp"
#include "audio/beat/sound_change.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Runs a beat network over the stream and starts it anew where one song changes into another: the
/// state of a recurrent network from one song misleads it for seconds in the next (it takes half
/// beats for beats). When SoundChange reports a change, a second stream of the network starts from
/// zero a window ago, processes the hops since, several at a time, and takes over once it has
/// caught up. Players who come in may look like another song, and a network without memory takes
/// their eighths for beats: where the second stream finds the beats of the first and others between
/// them, the first is used again.
///
/// Cost: one step of the network a hop; ten for the 0.1 s after a change, two for the 3 s after
/// that.
/// Threads: one. Real-time: next, reset yes.
class BeatDetector {
 public:
    /// `network`: not null.
    explicit BeatDetector(const std::shared_ptr<const BeatNetwork>& network);

    /// Evidence for the hop that lies the network's look-ahead before this frame.
    BeatEvidence next(const NetworkInput::Frame& frame) noexcept RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    // Sums of the beat evidence of both streams over the same hops.
    struct Comparison {
        int hops_left = 0;  // of the trial; 0: no trial
        float older = 0.0F;
        float younger = 0.0F;
        float both = 0.0F;  // of the lesser of the two
    };

    void compare(float older, float younger) noexcept;

    static constexpr std::size_t kCatchUp = 9;  // hops that the younger stream processes in one
    static constexpr int kTrial = 300;          // hops of comparison after a takeover
    static constexpr std::size_t kKept = SoundChange::kWindow;

    SoundChange change_;
    std::array<BeatNetworkStream, 2> streams_;
    std::size_t active_ = 0;  // stream whose evidence is used; the other is the younger
    std::size_t behind_ = 0;  // hops that the younger still has to process; 0: there is none
    std::array<NetworkInput::Frame, kKept> recent_{};  // input of the last hops, ring
    std::size_t newest_ = 0;                           // place in recent_
    Comparison trial_;
};

}  // namespace raks::audio
