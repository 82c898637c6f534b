#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/figures/motion_features.hpp"

/// Repeat segmentation: where each repeat begins and ends, as a pointer over the phase that may
/// change its tempo at the end of a repeat, jump, and rest.
namespace raks::motion {

/// One repeat within a track.
struct RepeatSpan {
    double start = 0.0;   ///< row of its first moment
    double length = 1.0;  ///< rows

    [[nodiscard]] double end() const noexcept { return start + length; }
};

/// Phases at which a repeat is compared with the others.
inline constexpr std::size_t kRepeatPhases = 32;

/// What a repeat looks like: mean and variance at each phase.
struct RepeatTemplate {
    std::vector<double> mean;      ///< kRepeatPhases x columns
    std::vector<double> variance;  ///< by column, > 0
};

/// The template of motion folded at a period, phase 0 at row 0.
[[nodiscard]] RepeatTemplate folded_template(const FeatureTrack& track, double period);

/// The template of some repeats (at least one): their mean, and how far they stray from it.
[[nodiscard]] RepeatTemplate template_of(const FeatureTrack& track,
                                         std::span<const RepeatSpan> repeats);

/// The likeliest division of a track into repeats of 0.85 to 1.15 `period` rows and gaps: a
/// semi-Markov Viterbi search, in which a repeat earns the log-likelihood of its rows under the
/// template over that under the whole track's distribution, beginning after a gap costs, and so
/// does a change of tempo from one repeat to the next. Rising, not overlapping; may be empty.
/// Deterministic. Cost: O(rows x 13 x (32 x columns)). Threads: workers. Real-time: no.
[[nodiscard]] std::vector<RepeatSpan> segment_repeats(const FeatureTrack& track,
                                                      const RepeatTemplate& repeat,
                                                      double period);

}  // namespace raks::motion
