#pragma once

#include <cmath>
#include <compare>

#include "base/time.hpp"

namespace raks {

/// A position or a distance on the beat axis, in beats (quarter notes of the dance). Beat k sounds
/// at Beats(k). Negative before the grid's anchor is fine.
class Beats {
 public:
    /// Beat 0.
    constexpr Beats() noexcept = default;
    /// `count`: beats, with fraction.
    constexpr explicit Beats(double count) noexcept : count_(count) {}
    [[nodiscard]] constexpr double count() const noexcept { return count_; }  ///< beats

    /// Sum of a position and a distance, or of two distances.
    friend constexpr Beats operator+(Beats a, Beats b) noexcept {
        return Beats(a.count_ + b.count_);
    }
    /// Distance from b to a, or the position b beats before a.
    friend constexpr Beats operator-(Beats a, Beats b) noexcept {
        return Beats(a.count_ - b.count_);
    }
    friend constexpr Beats operator-(Beats a) noexcept { return Beats(-a.count_); }  ///< negated
    /// Scaled.
    friend constexpr Beats operator*(double k, Beats a) noexcept { return Beats(k * a.count_); }
    friend constexpr auto operator<=>(Beats, Beats) = default;  ///< by count

 private:
    double count_ = 0.0;
};

/// Position inside one beat, [0, 1): 0 on the beat.
class BeatPhase {
 public:
    constexpr BeatPhase() noexcept = default;  ///< on the beat
    /// The phase of a position; negative positions wrap as well (-0.25 beats is phase 0.75).
    explicit BeatPhase(Beats position) noexcept {
        const double fraction = position.count() - std::floor(position.count());
        value_ = fraction < 1.0 ? fraction : 0.0;
    }
    [[nodiscard]] constexpr double value() const noexcept { return value_; }  ///< [0, 1)
    friend constexpr auto operator<=>(BeatPhase, BeatPhase) = default;        ///< by value

 private:
    double value_ = 0.0;
};

/// Tempo in beats per minute, > 0.
class Bpm {
 public:
    constexpr explicit Bpm(double bpm) noexcept : bpm_(bpm) {}  ///< > 0
    /// Tempo of beats that are so many seconds (> 0) apart.
    [[nodiscard]] static constexpr Bpm from_period(double seconds_per_beat) noexcept {
        return Bpm(60.0 / seconds_per_beat);
    }
    [[nodiscard]] constexpr double bpm() const noexcept { return bpm_; }  ///< beats a minute
    /// Beats a second.
    [[nodiscard]] constexpr double beats_per_second() const noexcept { return bpm_ / 60.0; }
    /// Seconds from beat to beat.
    [[nodiscard]] constexpr double seconds_per_beat() const noexcept { return 60.0 / bpm_; }
    friend constexpr auto operator<=>(Bpm, Bpm) = default;  ///< slower is less

 private:
    double bpm_;
};

}  // namespace raks
