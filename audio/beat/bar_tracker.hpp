#pragma once

#include <array>

#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Which beat of a bar of four is the first: the onsets of each band are folded over the bar in
/// half beats, forgotten slowly, and held against the patterns of a few dances in all four
/// rotations (accents alone point to 4 in salsa: bass and chord come there, ahead of the 1).
///
/// A first form: bars of four only, and no more than these patterns.
/// Threads: one. Real-time: yes.
class BarTracker {
 public:
    static constexpr int kBeatsPerBar = 4;

    /// One hop: its onset, and its place on the beat axis.
    void add(const Onset& onset, double beat_position) noexcept RAKS_NONBLOCKING;

    /// Beat number modulo 4 that is the downbeat.
    [[nodiscard]] int origin() const noexcept { return origin_; }
    /// How much better it fits than the next rotation, [0, 1].
    [[nodiscard]] float confidence() const noexcept { return confidence_; }

    /// The user says so: held until reset().
    void hold(long beat_number) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;

    static constexpr int kSlots = 2 * kBeatsPerBar;  ///< half beats
    using Profile = std::array<std::array<float, kOnsetBands>, kSlots>;

 private:
    void decide() noexcept;

    Profile profile_{};
    long last_beat_ = 0;
    int origin_ = 0;
    int candidate_ = 0;
    int candidate_beats_ = 0;
    float confidence_ = 0.0F;
    bool is_held_ = false;
};

}  // namespace raks::audio
