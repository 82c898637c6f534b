#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "audio/beat/network/beat_network.hpp"
#include "audio/beat/sound_change.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Listens with a beat network, and anew where the sound becomes another's: what a recurrent
/// network counted in one song misleads it for seconds in the next (it takes the half beat for the
/// beat). Where SoundChange tells a change, a second stream starts a window ago from nothing, hears
/// what came since, some hops at a time, and takes over once it has caught up. Players who come in
/// may sound like another song, and a network that knows nothing else takes their eighths for
/// beats: where the younger hears the beats of the older and others between them, the older goes
/// on.
///
/// Cost: one step of the network a hop; ten for the 0.1 s after a change, two for the 3 s after
/// that.
/// Threads: one. Real-time: next, reset yes.
class BeatDetector {
 public:
    /// `network`: not null.
    explicit BeatDetector(const std::shared_ptr<const BeatNetwork>& network);

    BeatEvidence next(const NetworkInput::Frame& frame) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    /// What two streams said of the same hops.
    struct Comparison {
        int hops_left = 0;  // to be compared; 0: no trial
        float older = 0.0F;
        float younger = 0.0F;
        float both = 0.0F;  // the lesser of them
    };

    void compare(float older, float younger) noexcept;

    static constexpr std::size_t kCatchUp = 9;  // hops heard anew in one
    static constexpr int kTrial = 300;          // hops
    static constexpr std::size_t kKept = SoundChange::kWindow;

    SoundChange change_;
    std::array<BeatNetworkStream, 2> streams_;
    std::size_t active_ = 0;  // stream that is heard; the other is the younger
    std::size_t behind_ = 0;  // hops that the younger has not heard yet; 0: there is none
    std::array<NetworkInput::Frame, kKept> recent_{};  // ring
    std::size_t newest_ = 0;
    Comparison trial_;
};

}  // namespace raks::audio
