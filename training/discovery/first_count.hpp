#pragma once

#include <functional>
#include <optional>
#include <span>

#include "motion/figures/figure_model.hpp"
#include "training/discovery/motion_signals.hpp"
#include "training/discovery/repeat_segmentation.hpp"

/// First count: where in a repeat count 1 lies, and how many beats a repeat has, from the feet.
namespace raks::motion {

/// How many beats a repeat of `seconds` has: `beats_per_bar`, twice or four times or half as many.
/// Preferred are tempi near 120 BPM, and at least a beat for each of its `landings`.
[[nodiscard]] int beats_of_repeat(double seconds, double landings, int beats_per_bar);

/// Landings in one repeat, on average; 0 where there are no repeats.
[[nodiscard]] double landings_of_repeat(std::span<const SignalLanding> landings,
                                        std::span<const RepeatSpan> repeats);

/// The phase of count 1, 0 to 1 of a repeat: where the leading foot (the lead's left, the follow's
/// right) lands after the longest rest of both feet, and half a repeat later the other foot does,
/// too; of about equal ones the one from which most landings lie on beats. `bonus`, if given,
/// is added for a phase (where the music has its bar lines). None where the leading foot does not
/// land in a third of the repeats. Threads: workers. Real-time: no.
[[nodiscard]] std::optional<double> phase_of_count_1(std::span<const SignalLanding> landings,
                                                     std::span<const RepeatSpan> repeats,
                                                     DanceRole role,
                                                     int beats,
                                                     const std::function<double(double)>& bonus);

}  // namespace raks::motion
