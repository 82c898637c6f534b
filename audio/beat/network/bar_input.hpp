#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/beat/network/beat_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Input of the bar network for one beat: the loudness of twelve groups of mel bands in each
/// quarter of the beat, relative to their own running level (so that neither gain nor timbre
/// matters); how much each group changed since the beat before; the beat network's evidence; and
/// the tempo. It contains the rhythm's pattern, bass line and harmony even where these have no
/// onsets.
///
/// Threads: one. Real-time: yes.
class BarInput {
 public:
    static constexpr std::size_t kBands = NetworkInput::kBands;  ///< mel bands
    static constexpr std::size_t kGroups = 12;                   ///< of three bands each
    static constexpr std::size_t kQuarters = 4;                  ///< of a beat
    /// Inputs in order: groups, quarter by quarter; changes of the groups; greatest evidence of
    /// beat, downbeat and half beat; log2 of the beat's length over 50 hops.
    static constexpr std::size_t kSize = kQuarters * kGroups + kGroups + 4;
    /// Input of one beat.
    using Frame = std::array<float, kSize>;
    /// Hops by which a sound shows before its time: a window reaches beyond the hop it is centred
    /// on.
    static constexpr double kAheadHops = 1.5;

    /// Adds a hop to the current beat: its mel magnitudes (kBands), the beat phase [0, 1), and the
    /// evidence that came with it.
    void add_hop(std::span<const float> mel_magnitudes,
                 double phase,
                 const BeatEvidence& evidence) noexcept RAKS_NONBLOCKING;

    /// Ends the current beat: returns its input and starts the next one.
    Frame next_beat() noexcept RAKS_NONBLOCKING;

    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING { *this = BarInput(); }

 private:
    using Bands = std::array<float, kBands>;

    [[nodiscard]] float compressed(float magnitude, std::size_t band, float floor) const noexcept;

    // Of the current beat.
    std::array<Bands, kQuarters> sums_{};
    std::array<int, kQuarters> hops_{};
    BeatEvidence most_;  // greatest evidence

    Bands level_{};   // running mean of whole beats
    Bands before_{};  // the last beat, compressed
    int beats_ = 0;   // whole beats so far, at most those that the level remembers
};

}  // namespace raks::audio
