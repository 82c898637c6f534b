#pragma once

#include <functional>
#include <optional>

#include "motion/figures/motion_features.hpp"

/// Repeat period: how long one repeat of a figure lasts in unlabelled motion, by epoch folding.
namespace raks::motion {

/// A period and how well the motion repeats with it.
struct RepeatPeriod {
    double rows = 0.0;  ///< of the track
    /// Share of the motion's variance that the phase of this period explains, less what it would
    /// explain of motion that never repeats; at most 1, about 0 for none.
    double explained = 0.0;
};

/// Which periods are tried and preferred.
struct PeriodSearch {
    double shortest = 0.8;  ///< seconds
    double longest = 6.7;   ///< seconds; never more than 1 / 2.5 of the motion
    /// Seconds that are likeliest, with a deviation of an octave: a period's multiples explain as
    /// much as itself, and so may a part of it.
    double likely = 2.6;
    /// Which periods, in seconds, are allowed; none: all.
    std::function<bool(double)> is_allowed = {};
};

/// Share of variance that folding at `rows` explains, in 32 phase bins, corrected for the few
/// cycles that there are: (e - 1/n) / (1 - 1/n) with n cycles, the expectation for motion that is
/// smooth within a bin and whose cycles have nothing to do with one another.
[[nodiscard]] double explained_by_period(const FeatureTrack& track, double rows);

/// The best period; none where the motion is shorter than two and a half of the shortest one.
/// Threads: workers. Real-time: no (periods tried x rows x columns).
[[nodiscard]] std::optional<RepeatPeriod> best_period(const FeatureTrack& track,
                                                      const PeriodSearch& search = {});

}  // namespace raks::motion
