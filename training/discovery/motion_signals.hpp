#pragma once

#include <cstddef>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "training/figures/figure_trainer.hpp"

/// Motion signals: a clip reduced to what tells its repeats, at one rate whatever the clip's.
namespace raks::motion {

/// Rows of MotionSignals a second.
inline constexpr double kSignalRate = 30.0;

/// A foot that came to rest after a step.
struct SignalLanding {
    double row = 0.0;        ///< when, in rows of the signals, fractional
    Side side = Side::left;  ///< which foot
};

/// The motion at kSignalRate. Columns, each about its mean: speed of the left and right foot (cut
/// at 1.5 m/s), place of the ankles left and forward of the hips, place of the hands seen from the
/// hips; places in the heading of the hips. Each of the three groups is divided by its deviation
/// and weighed, so that feet count most.
struct MotionSignals {
    FeatureTrack track;                   ///< rows x 12
    std::vector<SignalLanding> landings;  ///< of both feet, rising
    double movement = 0.0;                ///< the largest speed of a foot or a hand, m/s

    [[nodiscard]] double seconds() const noexcept {
        return static_cast<double>(track.rows()) / kSignalRate;
    }
};

/// Signals of a clip, its faults bridged, low-passed at 8 Hz before the rate is reduced. The clip
/// has poses and feet. Deterministic. Threads: workers. Real-time: no.
[[nodiscard]] MotionSignals motion_signals(const TrainingClip& clip);

/// Whether there is something to learn in a clip. Errors (one line): nothing moves, it is shorter
/// than two beats of the fastest dance, or a pose is not finite.
[[nodiscard]] Expected<void> check_motion(const TrainingClip& clip, const MotionSignals& signals);

/// Row `at` of a track between its rows; clamped at the ends. `to`: one number a column.
void row_between(const FeatureTrack& track, double at, std::span<double> to) noexcept;

}  // namespace raks::motion
