#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/beat/network/beat_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Input of the pulse network for one beat: how much the sound rose in each twelfth of the beat, in
/// six groups of mel bands, relative to the groups' running means; how much twelve groups changed
/// since the beat before; and the tempo. Twelfths hold the places of halves, thirds and quarters
/// apart.
///
/// Threads: one. Real-time: yes.
class PulseInput {
 public:
    static constexpr std::size_t kBands = NetworkInput::kBands;  ///< mel bands
    static constexpr std::size_t kGroups = 6;                    ///< of six bands: rises
    static constexpr std::size_t kTwelfths = 12;                 ///< of a beat
    static constexpr std::size_t kChanges = 12;                  ///< groups of three bands: changes
    /// Inputs in order: rises of the groups, twelfth by twelfth; changes; log2 of the beat's length
    /// over 50 hops.
    static constexpr std::size_t kSize = kTwelfths * kGroups + kChanges + 1;
    /// Input of one beat.
    using Frame = std::array<float, kSize>;
    /// Beats by which the first twelfth begins before the beat, so that the beat is in its middle.
    static constexpr double kEarlier = 0.5 / kTwelfths;

    /// Hops by which a sound shows before its time: a window reaches beyond the hop it is centred
    /// on.
    static constexpr double kAheadHops = 1.5;

    /// Adds a hop to the current beat: its mel magnitudes (kBands), and how much of the beat has
    /// passed since it began kEarlier before its time, [0, 1).
    void add_hop(std::span<const float> mel_magnitudes, double passed) noexcept RAKS_NONBLOCKING;

    /// Ends the current beat: returns its input and starts the next one.
    Frame next_beat() noexcept RAKS_NONBLOCKING;

    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING { *this = PulseInput(); }

 private:
    using Bands = std::array<float, kBands>;
    using Groups = std::array<float, kGroups>;

    // Of the current beat.
    std::array<Groups, kTwelfths> rises_{};
    Bands sum_{};
    int hops_ = 0;

    std::array<Bands, 2> logs_{};  // of the last hops, the newest first
    Bands level_{};                // running mean of the magnitudes
    long heard_ = 0;               // hops so far
    Groups usual_{};               // running mean of a twelfth's rise
    Bands before_{};               // the last beat's mean log magnitudes
    int beats_ = 0;                // whole beats so far, at most those that the means remember
};

}  // namespace raks::audio
