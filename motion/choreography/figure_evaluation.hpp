#pragma once

#include <cstddef>
#include <vector>

#include "base/beats.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/choreography/repeat_plan.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

/// Figure evaluation: from a written figure to poses. A dancer writes feet, weight and angles of
/// the body; heights, knees, heels, balance and jumps are computed. docs/reference/choreography.md
/// has the equations.
namespace raks::motion {

/// A place of a standing foot that the leg does not reach.
struct ReachMiss {
    Side foot = Side::left;  ///< which one
    double beat = 0.0;       ///< of the figure, in quarters
    double metres = 0.0;     ///< by which it is too far
};

/// The poses of several repeats of a figure.
struct EvaluatedFigure {
    std::vector<Pose> poses;              ///< with contacts: every foot that does not swing
    double frames_per_second = 60.0;      ///< of the poses
    double beats_per_frame = 1.0 / 30.0;  ///< at the danced tempo
    double first_beat = 0.0;              ///< beat of pose 0; the first repeat begins at beat 0
    int beats = 4;                        ///< of one repeat
    int repeats = 1;                      ///< danced, without the margins
    /// Over 5 mm, by foot; the worst of each quarter beat of the figure
    std::vector<ReachMiss> misses;

    /// Fractional frame of a beat.
    [[nodiscard]] double frame_of(double beat) const noexcept {
        return (beat - first_beat) / beats_per_frame;
    }
};

/// Dances a figure `options.repeats` times, with `options.margin` beats more at both ends. The same
/// figure, skeleton and options give the same bits. Threads: any. Real-time: no (about 1 ms for 5
/// poses).
[[nodiscard]] EvaluatedFigure evaluate_figure(const AuthoredFigure& figure,
                                              const Skeleton& skeleton,
                                              const EvaluationOptions& options);

}  // namespace raks::motion
