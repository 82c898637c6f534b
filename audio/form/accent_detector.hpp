#pragma once

#include <array>
#include <cstddef>

#include "audio/form/hop_sound.hpp"
#include "audio/form/last_chord.hpp"
#include "base/beat_grid.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Finds strong onsets: those that stand out among the onsets of the last half minute. An accent
/// is known 20 ms after its hop. Threads: one. Real-time: yes.
class AccentDetector {
 public:
    /// The next hop, with the grid at it. An accent of strength 0 is none.
    MusicAccent advance(HopIndex hop,
                        const HopSound& sound,
                        const BeatGrid& grid) noexcept RAKS_NONBLOCKING;
    /// Where the music ends, should it end now (LastChord).
    [[nodiscard]] StreamTime last_onset() const noexcept { return time_of_hop(chord_.hop()); }
    /// Forgets the stream.
    void reset() noexcept { *this = AccentDetector(); }

    static constexpr float kStrong = 0.5F;  ///< least strength of an accent
    static constexpr float kLeast = 0.1F;   ///< weight under which nothing is an onset
    static constexpr HopIndex kApart = 15;  ///< hops: one sound has one accent
    /// How strong the onset of a hop is, >= 0: hits, weighted by band.
    [[nodiscard]] static float weight(const HopSound& sound) noexcept;
    /// An accent of this strength at a hop.
    [[nodiscard]] static MusicAccent accent(HopIndex hop,
                                            const HopSound& sound,
                                            float strength,
                                            const BeatGrid& grid) noexcept;

 private:
    static constexpr std::size_t kAround = 5;   // hops: the middle one must be the greatest
    static constexpr std::size_t kBlocks = 30;  // seconds, of each the strongest onset is kept

    std::array<HopSound, kAround> sounds_{};  // of the last hops, ring
    std::size_t hops_ = 0;
    std::array<float, kBlocks> strongest_{};  // onset by second, ring
    LastChord chord_;                         // for last_onset()
    HopIndex last_ = -1'000;                  // hop of the last accent
};

}  // namespace raks::audio
