#pragma once

#include <cstddef>
#include <vector>

#include "base/beats.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/choreography/repeat_plan.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

/// From a written figure to poses: what the dancer writes is feet, weight and the body's angles;
/// heights, knees, heels, balance and jumps are worked out here. docs/reference/choreography.md has
/// the equations.
namespace raks::motion {

/// A foot that the leg does not reach where the figure wants it.
struct ReachMiss {
    Side foot = Side::left;
    double beat = 0.0;  ///< of the figure
    double metres = 0.0;
};

struct EvaluatedFigure {
    std::vector<Pose> poses;  ///< with contacts: a foot that is not in the air
    double frames_per_second = 60.0;
    double beats_per_frame = 1.0 / 30.0;
    double first_beat = 0.0;  ///< beat of pose 0; the first repeat begins at beat 0
    int beats = 4;            ///< of one repeat
    int repeats = 1;
    std::vector<ReachMiss> misses;  ///< by foot, the worst of each repeat's beats, over 5 mm

    /// Frame of a beat.
    [[nodiscard]] double frame_of(double beat) const noexcept {
        return (beat - first_beat) / beats_per_frame;
    }
};

/// Dances a figure `options.repeats` times, with `options.margin` beats more at both ends. The same
/// figure, skeleton and options give the same bits.
/// Threads: any. Real-time: no (about 1 ms for 5 poses).
[[nodiscard]] EvaluatedFigure evaluate_figure(const AuthoredFigure& figure,
                                              const Skeleton& skeleton,
                                              const EvaluationOptions& options);

}  // namespace raks::motion
