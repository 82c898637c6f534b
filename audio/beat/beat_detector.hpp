#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "audio/beat/network/beat_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Detects that the sound has become another's, as where one song is cut to the next: the loudness
/// of pairs of bands over the last 0.7 s, compared with its mean and variance over the seconds
/// before. Players who pause or come in make no other song: some bands must become louder and some
/// softer.
///
/// Threads: one. Real-time: yes.
class SoundChange {
 public:
    static constexpr std::size_t kBands = 18;  ///< pairs of mel bands
    /// Length of the compared window in hops of 10 ms; a change is reported about that late.
    static constexpr std::size_t kWindow = 70;

    /// Takes the next hop's loudness of the pairs of bands, see NetworkInput. True once for each
    /// change; none is reported within 2 s of the start or of another change.
    bool add(std::span<const float, kBands> loudness) noexcept RAKS_NONBLOCKING;

    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING { *this = SoundChange(); }

 private:
    using Sums = std::array<double, kBands>;
    static constexpr std::size_t kKept = 2 * kWindow;

    void slide(std::span<const float, kBands> loudness) noexcept;
    void learn() noexcept;
    [[nodiscard]] bool is_another() const noexcept;

    std::array<std::array<float, kBands>, kKept> ring_{};  // loudness of the last hops
    std::size_t next_ = 0;                                 // place in ring_
    int hops_ = 0;                                         // hops in ring_, at most kKept
    Sums newest_{};                                        // sum over the last window
    Sums before_{};                                        // sum over the window before that
    // Of windows' mean loudness, since the last change.
    Sums mean_{};
    Sums variance_{};
    int learnt_ = 0;  // hops in mean_ and variance_, at most as many as they remember
};

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
