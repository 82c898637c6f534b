#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/beat/network/beat_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What one beat's time sounded like, for a network that hears bars: how loud twelve groups of
/// bands were in each quarter of it, against their own running level (so that neither gain nor
/// timbre matters), how much each changed since the beat before, what the beat network said, and
/// the tempo. The rhythm's pattern, the bass line and the harmony lie in it; onsets do not have to.
///
/// Threads: one. Real-time: yes.
class BarInput {
 public:
    static constexpr std::size_t kBands = NetworkInput::kBands;
    static constexpr std::size_t kGroups = 12;
    static constexpr std::size_t kQuarters = 4;
    /// Groups of the quarters, quarter by quarter; changes of the groups; the greatest evidence of
    /// beat, downbeat and half beat; log2 of the beat's length over 50 hops.
    static constexpr std::size_t kSize = kQuarters * kGroups + kGroups + 4;
    using Frame = std::array<float, kSize>;
    /// Hops by which a sound shows before its moment: half of a window that is centred on it.
    static constexpr double kAheadHops = 1.5;

    /// One hop within the beat: its mel magnitudes (kBands), how much of the beat has passed,
    /// [0, 1), and the evidence that came with it.
    void add_hop(std::span<const float> mel_magnitudes,
                 double phase,
                 const BeatEvidence& evidence) noexcept RAKS_NONBLOCKING;

    /// The beat is over: what it sounded like.
    Frame next_beat() noexcept RAKS_NONBLOCKING;

    void reset() noexcept RAKS_NONBLOCKING { *this = BarInput(); }

 private:
    using Bands = std::array<float, kBands>;

    [[nodiscard]] float compressed(float magnitude, std::size_t band, float floor) const noexcept;

    // Of the beat that goes on.
    std::array<Bands, kQuarters> sums_{};
    std::array<int, kQuarters> hops_{};
    BeatEvidence most_;

    Bands level_{};   // running mean of whole beats
    Bands before_{};  // the last beat, compressed
    int beats_ = 0;   // so far, at most what the level remembers
};

}  // namespace raks::audio
