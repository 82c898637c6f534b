#pragma once

#include <array>
#include <cstdint>

#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What the onsets of the last bars say of the grid they were folded on.
enum class GridAdvice : std::uint8_t {
    keep,
    shift_half,   ///< the patterns fit clearly better half a beat off
    halve,        ///< twice too fast: every other beat is empty of drums and bass; beat 0 is a beat
    halve_other,  ///< the same; beat 1 is a beat
    double_up,    ///< twice too slow: drums and bass as strong between the beats as on them
};

/// Which beat of a bar of four is the first: the onsets of each band are folded over the bar in
/// half beats, forgotten slowly, and held against the patterns of a few dances in all four
/// rotations (accents alone point to 4 in salsa: bass and chord come there, ahead of the 1). The
/// same folded onsets tell when the beat itself is half a beat off, or at another octave.
///
/// A first form: bars of four only, and no more than these patterns.
/// Threads: one. Real-time: yes.
class BarTracker {
 public:
    static constexpr int kBeatsPerBar = 4;

    /// One hop: its onset, and its place on the beat axis. Advice comes when it has held for two
    /// bars or more; what was folded is then forgotten.
    GridAdvice add(const Onset& onset, double beat_position, double bpm) noexcept RAKS_NONBLOCKING;

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
    [[nodiscard]] GridAdvice advise(double bpm) noexcept;
    [[nodiscard]] GridAdvice octave_advice(double bpm) const noexcept;
    [[nodiscard]] bool has_onsets_between() const noexcept;
    [[nodiscard]] bool has_bell_between() const noexcept;
    void forget_profile() noexcept;

    Profile profile_{};
    int beats_folded_ = 0;
    GridAdvice pending_ = GridAdvice::keep;  // advice of the last beats, and for how many
    int pending_beats_ = 0;
    long last_beat_ = 0;
    int origin_ = 0;
    int candidate_ = 0;
    int candidate_beats_ = 0;
    float confidence_ = 0.0F;
    bool is_held_ = false;
};

}  // namespace raks::audio
